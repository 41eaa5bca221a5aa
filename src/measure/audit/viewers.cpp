#include "measure/audit/viewers.h"

#include <vector>

#include "kernels/random.h"
#include "kernels/sampling.h"
#include "measure/audit/ray_bundle.h"

namespace probegi {

namespace {

constexpr std::size_t kViewers = 4;  ///< of which one is chosen

}  // namespace

Result<void> placeViewers(const Tracer& tracer, std::span<FieldQuery> points, std::uint64_t seed) {
    const float magnitude = magnitudeOf(tracer);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const FieldQuery& point = points[i];
        kernels::uint state = kernels::hashCombine(kernels::uint(seed), kernels::uint(i));
        for (std::size_t k = 0; k < kViewers; ++k) {
            Ray ray = segment(point.position, point.normal, point.position, magnitude);
            const float u = kernels::nextRandom(state), v = kernels::nextRandom(state);
            ray.direction = k == 0 ? point.toViewer
                                   : kernels::toWorld(kernels::orthonormalBasis(point.normal),
                                                      kernels::sampleCosineHemisphere({u, v}));
            ray.far = Ray{}.far;
            rays.push_back(ray);
        }
    }
    std::vector<Hit> hits(rays.size());
    if (auto traced = tracer.closestHits(rays, hits); !traced) return traced;
    for (std::size_t i = 0; i < rays.size(); i += kViewers) {
        std::size_t best = i;
        for (std::size_t k = i; k < i + kViewers; ++k)
            if (hits[k].distance > hits[best].distance) best = k;
        points[i / kViewers].toViewer = rays[best].direction;
    }
    return {};
}

}  // namespace probegi
