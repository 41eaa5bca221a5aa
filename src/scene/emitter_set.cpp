#include "scene/emitter_set.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace probegi {

double emitterPower(const EmissiveTriangle& triangle, float luminance) {
    const double power = 0.5 * double(glm::length(glm::cross(triangle.edge1, triangle.edge2))) * double(luminance);
    return std::isfinite(power) ? power : 0.0;
}

EmitterSet makeEmitterSet(std::vector<EmissiveTriangle> triangles, std::vector<float> luminance) {
    double total = 0;
    for (const EmissiveTriangle& t : triangles) total += emitterPower(t, luminance[std::size_t(t.material)]);
    EmitterSet set{{}, std::move(luminance), total > 0 ? float(1 / total) : 0.0f};
    // Also if the sum overflows or underflows a float: such light is left to the rays.
    if (!(set.inversePower > 0 && std::isfinite(set.inversePower))) {
        set.inversePower = 0;
        return set;
    }
    double sum = 0;
    for (EmissiveTriangle& t : triangles) {
        sum += emitterPower(t, set.luminance[std::size_t(t.material)]);
        t.upTo = std::uint32_t(std::min(sum / total, 1.0) * 4294967295.0);
    }
    // Every number selects a triangle, and rounding never selects one that emits nothing.
    const std::uint32_t last = triangles.back().upTo;
    for (EmissiveTriangle& t : triangles)
        if (t.upTo == last) t.upTo = 0xffffffffu;
    set.triangles = std::move(triangles);
    return set;
}

}  // namespace probegi
