#include "fit/picture.h"

#include <algorithm>
#include <glm/common.hpp>
#include <new>

#include "camera_rays.h"
#include "probegi/measure.h"

namespace probegi::tool {

namespace {

constexpr std::size_t kBatch = 65536;  // bounds the memory for surfaces
constexpr float kOver = 0.7f;          // share of the primitives' colour over the scene's grey
constexpr glm::vec3 kMissing(1.0f);

/// What one tracer shows.
struct Seen {
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
};

Result<Seen> look(const Tracer& tracer, std::span<const Ray> rays) {
    Seen seen{std::vector<Hit>(rays.size()), std::vector<Surface>(rays.size())};
    if (auto traced = tracer.closestHits(rays, seen.hits); !traced) return traced.error();
    if (auto found = tracer.surfaces(rays, seen.hits, seen.surfaces); !found) return found.error();
    return seen;
}

}  // namespace

Result<HdrImage> drawPrimitives(const Tracer& scene, const Tracer& primitives, const PlacedCamera& camera, int width,
                                int height) try {
    HdrImage image(width, height);
    const std::vector<Ray> rays = primaryRays(camera, width, height);
    for (std::size_t begin = 0; begin < rays.size(); begin += kBatch) {
        const auto part = std::span(rays).subspan(begin, std::min(kBatch, rays.size() - begin));
        const auto triangles = look(scene, part);
        if (!triangles) return triangles.error();
        const auto solids = look(primitives, part);
        if (!solids) return solids.error();
        for (std::size_t i = 0; i < part.size(); ++i) {
            const bool there = triangles->hits[i].valid();
            const float grey = there ? 0.8f * shadeOf(triangles->surfaces[i], part[i]) : 0.0f;
            glm::vec3 pixel(grey);
            if (solids->hits[i].valid()) {
                const glm::vec3 colour = colourOf(std::size_t(solids->hits[i].primitive));
                pixel = glm::mix(pixel, colour * shadeOf(solids->surfaces[i], part[i]), kOver);
            } else if (there) {
                pixel = kMissing * (0.5f + 0.6f * grey);
            }
            image.pixels[begin + i] = pixel;
        }
    }
    return linearFromDisplay(image);
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory for the picture; choose a smaller --size");
}

}  // namespace probegi::tool
