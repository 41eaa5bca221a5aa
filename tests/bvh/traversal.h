#pragma once

#include <functional>
#include <vector>

#include "bvh/wide_bvh.h"
#include "probegi/tracer.h"

namespace probegi::test {

/// The data that kernels/trace/bvh_traverse.h reads, and how often it did.
struct TracedWorld {
    BvhArrays arrays;
    std::vector<kernels::BvhInstance> instances;
    std::uint32_t worldRoot = kernels::kBvhNone;
    std::uint32_t instancesRoot = kernels::kBvhNone;
    std::function<bool(int instance, int primitive, glm::vec2 barycentric)> alphaPasses;
    mutable std::size_t nodeVisits = 0;
    mutable std::size_t triangleTests = 0;
};

/// The kernel compiled as C++. One thread at a time.
Hit closestHit(const TracedWorld& world, const Ray& ray);
bool occluded(const TracedWorld& world, const Ray& ray);

}  // namespace probegi::test
