#include <algorithm>
#include <array>
#include <string_view>

#include "probegi/sdf.h"
#include "scene/checks.h"

namespace probegi {

using namespace checks;

namespace {

/// As validate(Scene): squares of the world's coordinates must fit into floats.
constexpr float kLargest = 1e9f;

bool inside(glm::vec3 v) {
    return within(v.x, -kLargest, kLargest) && within(v.y, -kLargest, kLargest) && within(v.z, -kLargest, kLargest);
}

/// What a shape calls its half sizes; nullptr: it has no such size.
struct SizeNames {
    std::array<const char*, 3> axes;
    bool secondMayBeZero = false;
};

SizeNames sizeNames(SdfShape shape) {
    switch (shape) {
        case SdfShape::sphere:
            return {{"radius", nullptr, nullptr}};
        case SdfShape::capsule:
            return {{"radius", "half length", nullptr}, true};
        case SdfShape::cylinder:
            return {{"radius", "half height", nullptr}};
        case SdfShape::plane:
            return {{nullptr, nullptr, nullptr}};
        case SdfShape::box:
        case SdfShape::roundedBox:
            break;
    }
    return {{"half size along x", "half size along y", "half size along z"}};
}

Result<void> validateSize(const std::string& what, const SdfPrimitive& p) {
    const SizeNames names = sizeNames(p.shape);
    for (int axis = 0; axis < 3; ++axis) {
        const char* name = names.axes[std::size_t(axis)];
        const float size = p.halfSize[axis];
        if (!name || (size > 0 && size <= kLargest) || (axis == 1 && names.secondMayBeZero && size == 0)) continue;
        return malformed(what, ": its ", name, " ", size, " must be > 0",
                         axis == 1 && names.secondMayBeZero ? " or 0" : "", " and at most ", kLargest, " m");
    }
    if (p.shape == SdfShape::roundedBox) {
        const float smallest = std::min({p.halfSize.x, p.halfSize.y, p.halfSize.z});
        if (!within(p.rounding, 0, smallest)) {
            return malformed(what, ": its rounding ", p.rounding, " must be 0 to its smallest half size, ", smallest);
        }
    }
    return {};
}

Result<void> validateFaces(const std::string& what, const SdfPrimitive& p) {
    if (p.faces.empty()) return {};
    if (p.shape != SdfShape::box && p.shape != SdfShape::roundedBox)
        return malformed(what, ": only boxes have colours by face");
    constexpr std::size_t kTexels = 6 * kSdfFaceSide * kSdfFaceSide;
    if (p.faces.size() != kTexels)
        return malformed(what, ": its faces have ", p.faces.size(), " texels; they must have ", kTexels);
    for (const glm::vec3& colour : p.faces)
        if (!within(colour.x, 0, 1) || !within(colour.y, 0, 1) || !within(colour.z, 0, 1))
            return malformed(what, ": a texel of its faces ", text(colour), " must be 0..1 in every component");
    return {};
}

Result<void> validatePrimitive(const std::string& what, const SdfPrimitive& p) {
    if (p.shape > SdfShape::plane) return malformed(what, ": its shape ", int(p.shape), " is none");
    if (!inside(p.centre)) return malformed(what, ": its centre ", text(p.centre), " must be within ", kLargest, " m");
    const glm::vec4 q(p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w);
    if (!finite(q) || !within(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 0.998f, 1.002f)) {
        return malformed(what, ": its rotation ", text(q), " must be a unit quaternion (x, y, z, w)");
    }
    if (auto ok = validateSize(what, p); !ok) return ok;
    if (!within(p.albedo.x, 0, 1) || !within(p.albedo.y, 0, 1) || !within(p.albedo.z, 0, 1)) {
        return malformed(what, ": its albedo ", text(p.albedo), " must be 0..1 in every component");
    }
    if (auto ok = validateFaces(what, p); !ok) return ok;
    if (!energy(p.emission)) return malformed(what, ": its emission ", text(p.emission), " must be 0 to ", kBrightest);
    return {};
}

}  // namespace

Result<void> validate(const SdfScene& sdf) {
    if (sdf.primitives.size() > std::size_t(kMaxSdfPrimitives)) {
        return malformed(sdf.primitives.size(), " primitives are more than ", kMaxSdfPrimitives, "; use fewer");
    }
    for (std::size_t i = 0; i < sdf.primitives.size(); ++i) {
        const SdfPrimitive& primitive = sdf.primitives[i];
        if (auto ok = validatePrimitive(title("primitive", i, primitive.name), primitive); !ok) return ok;
    }
    return {};
}

}  // namespace probegi
