#include "audit/picture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "camera_rays.h"
#include "probegi/measure.h"

namespace probegi::tool {

namespace {

constexpr double kAlmostLight = 0.01;  // of the mean, added to both lights that are compared
constexpr double kAllStops = 2;        // by which light is wrong where the colour is at its strongest

double meanLight(const SeenLeaks& seen) {
    double sum = 0;
    for (const LeakPoint& p : seen.points) sum += p.light;
    return seen.points.empty() ? 0 : sum / double(seen.points.size());
}

}  // namespace

Result<SeenLeaks> leaksSeen(const Context& context, const Tracer& tracer, const Field& field,
                            const PlacedCamera& camera, int width, int height) {
    const std::vector<Ray> rays = primaryRays(camera, width, height);
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    if (auto traced = tracer.closestHits(rays, hits); !traced) return traced.error();
    if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found.error();
    SeenLeaks seen;
    std::vector<FieldQuery> queries;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].valid() || surfaces[i].backface) continue;
        queries.push_back({surfaces[i].position, surfaces[i].geometricNormal, -rays[i].direction});
        seen.pixels.push_back(i);
    }
    auto points = leaksAt(context, tracer, field, queries);
    if (!points) return points.error();
    seen.points = std::move(*points);
    return seen;
}

HdrImage drawLeaks(const HdrImage& color, float exposure, const SeenLeaks& seen, const AuditDesc& desc) {
    constexpr glm::vec3 kLight(1.0f, 0.12f, 0.05f), kShadow(0.15f, 0.4f, 1.0f);
    HdrImage shown = color;
    for (glm::vec3& pixel : shown.pixels) {
        const glm::vec3 display = toDisplay(pixel, {exposure, true});
        pixel = glm::vec3(0.15f + 0.5f * glm::dot(display, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
    }
    const double least = std::max(kAlmostLight * meanLight(seen), 1e-20);
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
        const LeakPoint& p = seen.points[i];
        const double stops = std::abs(std::log2((p.light + least) / (p.unleaked + least)));
        if (std::abs(p.leak) < desc.least || stops < desc.leastStops) continue;
        const auto strength = float(std::min(0.3 + 0.6 * stops / kAllStops, 0.9));
        glm::vec3& pixel = shown.pixels[seen.pixels[i]];
        pixel = glm::mix(pixel, p.leak > 0 ? kLight : kShadow, strength);
    }
    return linearFromDisplay(shown);
}

}  // namespace probegi::tool
