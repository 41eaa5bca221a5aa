#include "bench/points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace probegi::tool {

Result<std::vector<FieldQuery>> picturePoints(const Tracer& tracer, std::span<const Ray> rays) {
    constexpr std::size_t kBatch = 65536;  // bounds the memory for surfaces
    std::vector<FieldQuery> points;
    for (std::size_t begin = 0; begin < rays.size(); begin += kBatch) {
        const auto batch = rays.subspan(begin, std::min(kBatch, rays.size() - begin));
        std::vector<Hit> hits(batch.size());
        std::vector<Surface> surfaces(batch.size());
        if (auto hit = tracer.closestHits(batch, hits); !hit) return hit.error();
        if (auto found = tracer.surfaces(batch, hits, surfaces); !found) return found.error();
        for (std::size_t i = 0; i < batch.size(); ++i)
            if (hits[i].valid())
                points.push_back({surfaces[i].position, surfaces[i].shadingNormal, -batch[i].direction});
    }
    return points;
}

}  // namespace probegi::tool
