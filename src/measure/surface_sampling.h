#pragma once

#include <cstdint>
#include <vector>

#include "probegi/measure.h"

namespace probegi {

/// A point of surfacePoints(), and the surface that it stands for.
struct SurfaceSample {
    FieldQuery query;
    double area = 0;  ///< square metres; of two-sided surfaces each side counts
};

/// surfacePoints() of any seed, with their areas. Errors: the same.
Result<std::vector<SurfaceSample>> sampleSurfaces(const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                                                  int count, std::uint64_t seed);

}  // namespace probegi
