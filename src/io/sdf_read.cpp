#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/file_bytes.h"
#include "io/json_text.h"
#include "io/sdf_shapes.h"
#include "io/sdf_text.h"
#include "scene/checks.h"

namespace probegi {

namespace io {

namespace {

using nlohmann::json;

constexpr int kVersion = 1;

/// One primitive's members, which are crossed out as they are read; what is left over is a mistake.
class Members {
public:
    Members(const json& object, std::string what) : m_object(object), m_what(std::move(what)) {}

    bool has(const char* key) const { return m_object.contains(key); }
    const std::string& what() const { return m_what; }

    float number(const char* key) {
        const json& value = member(key);
        if (!value.is_number()) refuseMalformed("{}: its '{}' must be a number", m_what, key);
        return single(key, value);
    }
    template <class Vector>
    Vector numbers(const char* key) {
        const json& value = member(key);
        constexpr int kCount = Vector::length();
        const auto isNumber = [](const json& element) { return element.is_number(); };
        if (!value.is_array() || value.size() != std::size_t(kCount) ||
            !std::all_of(value.begin(), value.end(), isNumber))
            refuseMalformed("{}: its '{}' must be {} numbers in brackets", m_what, key, kCount);
        Vector vector;
        for (int i = 0; i < kCount; ++i) vector[i] = single(key, value[std::size_t(i)]);
        return vector;
    }
    std::string text(const char* key) {
        const json& value = member(key);
        if (!value.is_string()) refuseMalformed("{}: its '{}' must be a text in quotes", m_what, key);
        return value.get<std::string>();
    }
    std::vector<std::string> texts(const char* key) {
        const json& value = member(key);
        const auto isText = [](const json& element) { return element.is_string(); };
        if (!value.is_array() || !std::all_of(value.begin(), value.end(), isText))
            refuseMalformed("{}: its '{}' must be a list of texts", m_what, key);
        return value.get<std::vector<std::string>>();
    }
    bool flag(const char* key) {
        const json& value = member(key);
        if (!value.is_boolean()) refuseMalformed("{}: its '{}' must be true or false", m_what, key);
        return value.get<bool>();
    }

    /// Refuses members that nothing has read.
    void finish(const char* owner) const {
        for (const auto& [key, value] : m_object.items()) {
            if (std::find(m_read.begin(), m_read.end(), key) != m_read.end()) continue;
            refuseMalformed("{}: a {} has no '{}'; correct the spelling or remove it", m_what, owner,
                            checks::quotable(key));
        }
    }

private:
    const json& member(const char* key) {
        m_read.emplace_back(key);
        const auto found = m_object.find(key);
        if (found == m_object.end()) refuseMalformed("{}: it has no '{}'", m_what, key);
        return *found;
    }
    float single(const char* key, const json& value) const {
        const auto number = value.get<double>();
        if (!(std::abs(number) <= 3e38)) refuseMalformed("{}: its '{}' has a number that is too large", m_what, key);
        return float(number);
    }

    const json& m_object;
    std::string m_what;
    std::vector<std::string> m_read;
};

const SdfShapeText& readShape(Members& members) {
    const std::string name = members.text("shape");
    for (const SdfShapeText& shape : kSdfShapeTexts)
        if (name == shape.name) return shape;
    refuseMalformed("{}: there is no shape '{}'; there are box, roundedBox, sphere, capsule, cylinder and plane",
                    members.what(), checks::quotable(name));
}

/// (x, y, z, w) of any length but zero: people write them by hand.
glm::quat readRotation(Members& members) {
    const auto q = members.numbers<glm::vec4>("rotation");
    const double square = double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w;
    if (!(square > 1e-12 && square < 1e12))
        refuseMalformed("{}: its 'rotation' must be a quaternion, x, y, z and w", members.what());
    // One that is unit already stays what it was.
    const auto scale = std::abs(square - 1) < 1e-6 ? 1.0f : float(1 / std::sqrt(square));
    return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

/// A texel's channel of two hexadecimal digits; the square root of the colour in 255ths.
float readChannel(const std::string& digits, std::size_t at, const std::string& what) {
    unsigned value = 0;
    const char* end = digits.data() + at + 2;
    const auto [rest, error] = std::from_chars(digits.data() + at, end, value, 16);
    if (error != std::errc() || rest != end)
        refuseMalformed("{}: its 'faces' must be made of hexadecimal digits, 0 to 9 and a to f", what);
    const float root = float(value) * (1.0f / 255.0f);
    return root * root;
}

std::vector<glm::vec3> readFaces(Members& members) {
    constexpr std::size_t kDigits = 6 * kSdfFaceSide * kSdfFaceSide;
    const std::vector<std::string> faces = members.texts("faces");
    std::vector<glm::vec3> texels;
    for (const std::string& digits : faces) {
        if (faces.size() != 6 || digits.size() != kDigits) break;
        for (std::size_t i = 0; i < kDigits; i += 6)
            texels.emplace_back(readChannel(digits, i, members.what()), readChannel(digits, i + 2, members.what()),
                                readChannel(digits, i + 4, members.what()));
    }
    if (texels.size() != kDigits)
        refuseMalformed("{}: its 'faces' must be 6 texts of {} hexadecimal digits each", members.what(), kDigits);
    return texels;
}

SdfPrimitive readPrimitive(const json& value, std::size_t number) {
    if (!value.is_object()) refuseMalformed("primitive {} must be an object in braces", number);
    const auto name = value.find("name");
    const bool named = name != value.end() && name->is_string();
    Members members(value, checks::title("primitive", number, named ? name->get<std::string>() : ""));
    SdfPrimitive p;
    if (members.has("name")) p.name = members.text("name");
    const SdfShapeText& shape = readShape(members);
    p.shape = shape.shape;
    p.centre = members.numbers<glm::vec3>("centre");
    if (members.has("rotation")) p.rotation = readRotation(members);
    if (shape.box) p.halfSize = members.numbers<glm::vec3>("halfSize");
    for (int axis = 0; axis < 2; ++axis) {
        const char* key = shape.sizes[std::size_t(axis)];
        if (key) p.halfSize[axis] = members.number(key);
    }
    if (p.shape == SdfShape::roundedBox) p.rounding = members.number("rounding");
    if (members.has("albedo")) p.albedo = members.numbers<glm::vec3>("albedo");
    if (members.has("faces")) p.faces = readFaces(members);
    if (members.has("emission")) p.emission = members.numbers<glm::vec3>("emission");
    if (members.has("node")) p.node = members.text("node");
    if (members.has("pinned")) p.pinned = members.flag("pinned");
    members.finish(shape.name);
    return p;
}

void checkVersion(const json& root) {
    const auto version = root.find("sdf");
    if (version == root.end() || !version->is_number_unsigned())
        refuseMalformed("is not a scene of primitives: it has no \"sdf\": {}", kVersion);
    if (*version != kVersion)
        refuse(ErrorCode::unsupported, "is of version {} of its format; this ProbeGI reads {}", version->dump(),
               kVersion);
}

SdfScene readScene(const json& root) {
    checkVersion(root);
    for (const auto& [key, value] : root.items()) {
        if (key == "sdf" || key == "primitives") continue;
        refuseMalformed("beside \"sdf\" and \"primitives\" it has '{}'; correct the spelling or remove it",
                        checks::quotable(key));
    }
    const auto primitives = root.find("primitives");
    if (primitives == root.end() || !primitives->is_array()) refuseMalformed("it has no list of \"primitives\"");
    if (primitives->size() > std::size_t(kMaxSdfPrimitives))
        refuseMalformed("{} primitives are more than {}; use fewer", primitives->size(), kMaxSdfPrimitives);
    SdfScene sdf;
    for (std::size_t i = 0; i < primitives->size(); ++i) sdf.primitives.push_back(readPrimitive((*primitives)[i], i));
    if (const auto valid = validate(sdf); !valid) refuse(valid.error().code, "{}", valid.error().message);
    return sdf;
}

}  // namespace

Result<SdfScene> loadSdfFromMemory(std::string_view name, std::span<const std::uint8_t> text,
                                   const ReadLimits& limits) {
    return guarded(name, [&] {
        Budget budget(limits, text.size(), kGeometryShare);
        return readScene(parseJsonText(text, budget, "a scene of primitives"));
    });
}

}  // namespace io

Result<SdfScene> loadSdf(const std::filesystem::path& path, const ReadLimits& limits) {
    const auto bytes = io::guarded(path.string(), [&] { return io::readFile(path); });
    if (!bytes) return bytes.error();
    return io::loadSdfFromMemory(path.string(), *bytes, limits);
}

}  // namespace probegi
