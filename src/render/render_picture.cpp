#include <algorithm>
#include <chrono>
#include <new>

#include "core/parallel.h"
#include "core/progress.h"
#include "geometry/picture_desc.h"
#include "render/tile_renderer.h"

namespace probegi {

namespace {

constexpr int kTileWidth = 64;
constexpr int kTileSamples = 2048;  // what stays in a core's second-level cache

std::vector<Tile> makeTiles(const PictureDesc& desc) {
    const int perPixel = desc.samplesPerAxis * desc.samplesPerAxis;
    const int tileHeight = std::max(1, kTileSamples / (kTileWidth * perPixel));
    std::vector<Tile> tiles;
    for (int y = 0; y < desc.height; y += tileHeight)
        for (int x = 0; x < desc.width; x += kTileWidth)
            tiles.push_back({x, y, std::min(kTileWidth, desc.width - x), std::min(tileHeight, desc.height - y)});
    return tiles;
}

Result<RenderedPicture> renderTiles(const Context& context, const Tracer& tracer, const Lighting& lighting,
                                    const Field* field, const PictureDesc& desc) {
    const auto start = std::chrono::steady_clock::now();
    RenderedPicture rendered{emptyPicture(desc.width, desc.height), {}};
    const std::vector<Tile> tiles = makeTiles(desc);
    TileRenderer renderer(tracer, lighting, field, desc);
    Progress progress(context, "rendering", double(tiles.size()));
    const auto render = [&](std::size_t begin, std::size_t end) -> Result<void> {
        thread_local TileSamples samples;
        for (std::size_t tile = begin; tile < end && !progress.cancelled(); ++tile) {
            if (auto done = renderer.render(tiles[tile], samples, rendered.picture); !done) return done;
            progress.advance();
        }
        return {};
    };
    if (auto done = tryParallelFor(context, tiles.size(), 1, render); !done) return done.error();
    if (progress.cancelled()) return fail(ErrorCode::cancelled, "rendering was cancelled");
    rendered.times = renderer.threadTimes();
    for (double* stage : {&rendered.times.primary, &rendered.times.direct, &rendered.times.query})
        *stage /= context.threads();
    rendered.times.total = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return rendered;
}

}  // namespace

Result<RenderedPicture> renderPicture(const Context& context, const Tracer& tracer, const Lighting& lighting,
                                      const Field* field, const PictureDesc& desc) {
    if (const auto checked = validatePictureDesc(desc); !checked) return checked.error();
    try {
        return renderTiles(context, tracer, lighting, field, desc);
    } catch (const std::bad_alloc&) {
        return pictureDoesNotFit(desc);
    }
}

}  // namespace probegi
