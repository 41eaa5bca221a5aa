#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "io/file_output.h"
#include "io/refused.h"
#include "io/sdf_shapes.h"
#include "io/sdf_text.h"
#include "kernels/sdf/face_texels.h"

namespace probegi {

namespace io {

namespace {

/// Members in the order in which they were added, and floats with as many digits as floats have.
using Text =
    nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool, std::int64_t, std::uint64_t, float>;

Text array(glm::vec3 v) {
    return Text::array({v.x, v.y, v.z});
}

/// Six texts of two hexadecimal digits a channel: red, green, blue, texel by texel.
Text facesText(std::span<const glm::vec3> texels) {
    Text faces = Text::array();
    const std::size_t perFace = texels.size() / 6;
    for (std::size_t face = 0; face < 6; ++face) {
        std::string digits;
        for (const glm::vec3& colour : texels.subspan(face * perFace, perFace))
            for (int channel = 0; channel < 3; ++channel)
                digits += fmt::format("{:02x}", kernels::sdfPackChannel(colour[channel]));
        faces.push_back(digits);
    }
    return faces;
}

Text primitiveText(const SdfPrimitive& p) {
    const SdfPrimitive unset;
    const auto shape = std::find_if(kSdfShapeTexts.begin(), kSdfShapeTexts.end(),
                                    [&](const SdfShapeText& text) { return text.shape == p.shape; });
    Text text = Text::object();
    if (!p.name.empty()) text["name"] = p.name;
    text["shape"] = shape->name;
    text["centre"] = array(p.centre);
    if (p.rotation != unset.rotation)
        text["rotation"] = Text::array({p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w});
    if (shape->box) text["halfSize"] = array(p.halfSize);
    for (int axis = 0; axis < 2; ++axis) {
        const char* key = shape->sizes[std::size_t(axis)];
        if (key) text[key] = p.halfSize[axis];
    }
    if (p.shape == SdfShape::roundedBox) text["rounding"] = p.rounding;
    text["albedo"] = array(p.albedo);
    if (!p.faces.empty()) text["faces"] = facesText(p.faces);
    if (p.emission != unset.emission) text["emission"] = array(p.emission);
    if (!p.node.empty()) text["node"] = p.node;
    if (p.pinned) text["pinned"] = true;
    return text;
}

}  // namespace

std::string sdfText(const SdfScene& sdf) {
    std::string text = "{\n  \"sdf\": 1,\n  \"primitives\": [";
    for (std::size_t i = 0; i < sdf.primitives.size(); ++i) {
        text += i == 0 ? "\n    " : ",\n    ";
        text += primitiveText(sdf.primitives[i]).dump(-1, ' ', false, Text::error_handler_t::replace);
    }
    return text + "\n  ]\n}\n";
}

}  // namespace io

Result<void> saveSdf(const std::filesystem::path& path, const SdfScene& sdf) {
    if (const auto valid = validate(sdf); !valid) {
        return fail(valid.error().code, fmt::format("{}: {}", path.string(), valid.error().message));
    }
    return io::guarded(path.string(), [&] {
        const std::string text = io::sdfText(sdf);
        io::writeBytes(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    });
}

}  // namespace probegi
