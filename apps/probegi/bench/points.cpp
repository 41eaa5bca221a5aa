#include "bench/points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace probegi::tool {

std::vector<Ray> primaryRays(const PlacedCamera& camera, int width, int height) {
    const float pixel = 2.0f * std::tan(0.5f * camera.yfov) / float(height);
    const glm::vec3 right = pixel * glm::cross(camera.forward, camera.up), up = pixel * camera.up;
    std::vector<Ray> rays;
    rays.reserve(std::size_t(width) * std::size_t(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float fromMiddleX = float(x) + 0.5f - 0.5f * float(width);
            const float fromMiddleY = 0.5f * float(height) - float(y) - 0.5f;
            const glm::vec3 direction = camera.forward + fromMiddleX * right + fromMiddleY * up;
            rays.push_back({camera.position, 0.0f, glm::normalize(direction)});
        }
    return rays;
}

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
