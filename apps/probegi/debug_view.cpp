#include "debug_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <new>
#include <numbers>
#include <vector>

#include "bench/points.h"
#include "probegi/measure.h"
#include "probegi/tracer.h"

namespace probegi::tool {

namespace {

// Hues that stay apart however many volumes there are.
glm::vec3 colourOf(std::size_t volume) {
    constexpr float kStrength = 0.85f, kBrightness = 0.95f;
    const float hue = float(volume) * (1.0f / std::numbers::phi_v<float>);
    const glm::vec3 wheel = glm::abs(glm::fract(hue + glm::vec3(0.0f, 2.0f / 3.0f, 1.0f / 3.0f)) * 6.0f - 3.0f) - 1.0f;
    return kBrightness * glm::mix(glm::vec3(1.0f), glm::clamp(wheel, 0.0f, 1.0f), kStrength);
}

glm::vec3 volumesAt(const Field& field, glm::vec3 point) {
    glm::vec3 colour(0.0f);
    const auto shares = field.control().volumeShares(point);
    for (std::size_t volume = 0; shares && volume < shares->size(); ++volume)
        colour += (*shares)[volume] * colourOf(volume);
    return colour;
}

glm::vec3 coverageAt(const Field& field, glm::vec3 point) {
    return glm::mix(glm::vec3(0.85f, 0.1f, 0.05f), glm::vec3(0.2f, 0.75f, 0.3f), field.control().coverage(point));
}

float shadeOf(const Surface& surface, const Ray& ray) {
    return 0.4f + 0.6f * std::abs(glm::dot(surface.shadingNormal, ray.direction));
}

Result<void> drawRows(const DebugView& view, const Field& field, const Tracer& tracer, std::span<const Ray> rays,
                      std::span<glm::vec3> pixels) {
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    if (auto hit = tracer.closestHits(rays, hits); !hit) return hit;
    if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (hits[i].valid()) pixels[i] = view.colour(field, surfaces[i].position) * shadeOf(surfaces[i], rays[i]);
    return {};
}

}  // namespace

std::span<const DebugView> debugViews() {
    static constexpr DebugView kViews[] = {
        {"volumes", "which volume answers, each in a colour of its own, blended by their shares", false, volumesAt},
        {"coverage", "green where the volumes cover a point, red where they do not", false, coverageAt}};
    return kViews;
}

const DebugView* findDebugView(const std::string& name) {
    const auto views = debugViews();
    const auto found = std::find_if(views.begin(), views.end(), [&](const DebugView& v) { return v.name == name; });
    return found == views.end() ? nullptr : &*found;
}

Result<HdrImage> drawDebugView(const DebugView& view, const Field& field, const Tracer& tracer,
                               const PlacedCamera& camera, int width, int height) try {
    constexpr std::size_t kBatch = 65536;  // bounds the memory for surfaces
    HdrImage image;
    image.width = width;
    image.height = height;
    image.pixels.assign(std::size_t(width) * std::size_t(height), glm::vec3(0.0f));
    const std::vector<Ray> rays = primaryRays(camera, width, height);
    for (std::size_t begin = 0; begin < rays.size(); begin += kBatch) {
        const std::size_t count = std::min(kBatch, rays.size() - begin);
        if (auto drawn = drawRows(view, field, tracer, std::span(rays).subspan(begin, count),
                                  std::span(image.pixels).subspan(begin, count));
            !drawn)
            return drawn.error();
    }
    return linearFromDisplay(image);
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory for the debug picture; choose a smaller --size");
}

}  // namespace probegi::tool
