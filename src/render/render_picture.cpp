#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <new>

#include "core/parallel.h"
#include "core/progress.h"
#include "render/tile_renderer.h"
#include "surface/picture_desc.h"

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

// What went wrong first on any of the threads.
class FirstError {
public:
    void set(const Error& error) {
        const std::scoped_lock lock(m_mutex);
        if (!m_happened.exchange(true)) m_error = error;
    }
    explicit operator bool() const noexcept { return m_happened; }
    const Error& get() const noexcept { return m_error; }  // once the threads are done

private:
    std::mutex m_mutex;
    std::atomic<bool> m_happened{false};
    Error m_error;
};

Result<RenderedPicture> renderTiles(const Context& context, const Tracer& tracer, const Lighting& lighting,
                                    const Field* field, const PictureDesc& desc) {
    const auto start = std::chrono::steady_clock::now();
    RenderedPicture rendered{emptyPicture(desc.width, desc.height), {}};
    const std::vector<Tile> tiles = makeTiles(desc);
    TileRenderer renderer(tracer, lighting, field, desc);
    Progress progress(context, "rendering", double(tiles.size()));
    tbb::enumerable_thread_specific<TileSamples> scratch;
    FirstError failure;
    parallelFor(context, tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
        // A query of the field runs on all threads. Without the fence a thread that waits for its share would begin
        // another tile and overwrite the samples of the one that it is in.
        tbb::this_task_arena::isolate([&] {
            for (std::size_t tile = begin; tile < end && !progress.cancelled() && !failure; ++tile) {
                if (const auto done = renderer.render(tiles[tile], scratch.local(), rendered.picture); !done)
                    failure.set(done.error());
                progress.advance();
            }
        });
    });
    if (failure) return tl::unexpected(failure.get());
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
    if (const auto checked = validatePictureDesc(desc); !checked) return tl::unexpected(checked.error());
    try {
        return renderTiles(context, tracer, lighting, field, desc);
    } catch (const std::bad_alloc&) {
        return tl::unexpected(pictureDoesNotFit(desc));
    }
}

}  // namespace probegi
