#include "sdf/sdf_emitters.h"

#include "kernels/screen/colour.h"
#include "kernels/sdf/distance.h"

namespace probegi {

namespace {

/// The two triangles of a box's face on one side of an axis, front outward.
void appendFace(const kernels::SdfSolid& box, int axis, float side, std::int32_t material,
                std::vector<EmissiveTriangle>& out) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    glm::vec3 across(0.0f), along(0.0f), middle(0.0f);
    across[next] = 2.0f * box.halfSize[next];
    along[last] = 2.0f * side * box.halfSize[last];
    middle[axis] = side * box.halfSize[axis];
    across = kernels::sdfToWorld(box, across);
    along = kernels::sdfToWorld(box, along);
    const glm::vec3 corner = box.centre + kernels::sdfToWorld(box, middle) - 0.5f * (across + along);
    EmissiveTriangle half;
    half.material = material;
    half.corner = corner;
    half.edge1 = across;
    half.edge2 = along;
    out.push_back(half);
    half.corner = corner + across + along;
    half.edge1 = -across;
    half.edge2 = -along;
    out.push_back(half);
}

}  // namespace

EmitterSet emittersOf(std::span<const SdfPrimitive> primitives, std::span<const kernels::SdfSolid> solids) {
    std::vector<EmissiveTriangle> triangles;
    std::vector<float> luminance(primitives.size(), 0.0f);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const float emitted = kernels::luminance(primitives[i].emission);
        if (primitives[i].shape != SdfShape::box || !(emitted > 0.0f)) continue;
        luminance[i] = emitted;
        for (int axis = 0; axis < 3; ++axis)
            for (const float side : {-1.0f, 1.0f}) appendFace(solids[i], axis, side, std::int32_t(i), triangles);
    }
    return makeEmitterSet(std::move(triangles), std::move(luminance));
}

}  // namespace probegi
