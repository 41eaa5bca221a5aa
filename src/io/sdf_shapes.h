#pragma once

#include <array>

#include "probegi/sdf.h"

namespace probegi::io {

/// How a shape is spelt in a file, and its sizes: each a number that is a component of SdfPrimitive::halfSize, but for
/// boxes, whose "halfSize" is all three.
struct SdfShapeText {
    SdfShape shape;
    const char* name;
    std::array<const char*, 2> sizes;  ///< keys of halfSize.x and halfSize.y; nullptr: none
    bool box = false;
};

inline constexpr std::array<SdfShapeText, 6> kSdfShapeTexts = {{
    {SdfShape::box, "box", {nullptr, nullptr}, true},
    {SdfShape::roundedBox, "roundedBox", {nullptr, nullptr}, true},
    {SdfShape::sphere, "sphere", {"radius", nullptr}},
    {SdfShape::capsule, "capsule", {"radius", "halfLength"}},
    {SdfShape::cylinder, "cylinder", {"radius", "halfHeight"}},
    {SdfShape::plane, "plane", {nullptr, nullptr}},
}};

}  // namespace probegi::io
