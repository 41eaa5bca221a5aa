#include "io/gltf_strict.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <climits>
#include <string_view>

#include "io/refused.h"

namespace probegi::io {

namespace {

using nlohmann::json;

// Of accessors, buffer views and buffers: a negative one would be treated as missing or huge.
constexpr std::array<std::string_view, 6> kSizes{"buffer",     "bufferView", "byteLength",
                                                 "byteOffset", "byteStride", "count"};
// Indices: a non-integer would be treated as missing.
constexpr std::array<std::string_view, 13> kIndices{"camera",   "indices", "input",  "light",   "material",
                                                    "mesh",     "node",    "output", "sampler", "scene",
                                                    "skeleton", "skin",    "source"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void checkNumber(const std::string& path, const std::string& name, const json& number) {
    const bool size = contains(kSizes, name);
    if (!size && !contains(kIndices, name)) return;
    if (!number.is_number_integer()) {
        refuseMalformed("{}: {} {} is not a whole number", path, name, number.dump());
    }
    if (size && !number.is_number_unsigned()) {
        refuseMalformed("{}: {} {} may not be negative", path, name, number.dump());
    }
    const bool index = !size || name == "buffer" || name == "bufferView";
    if (index && number.is_number_unsigned() && number.get<std::uint64_t>() > INT_MAX) {
        refuseMalformed("{}: {} {} is too large", path, name, number.dump());
    }
}

/// Checks one element of a root array. Extensions have their own rules and are skipped. Recursion is safe: the text
/// has passed parseJsonText().
void checkNumbers(const std::string& path, const json& value) {
    if (value.is_array()) {
        for (const json& element : value) checkNumbers(path, element);
    } else if (value.is_object()) {
        for (const auto& [name, member] : value.items()) {
            if (name == "extras") continue;
            if (member.is_number()) checkNumber(path, name, member);
            if (member.is_structured()) checkNumbers(path, member);
        }
    }
}

void checkVersion(const json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object() || !asset->contains("minVersion")) return;
    const json& wanted = (*asset)["minVersion"];
    const std::string text = wanted.is_string() ? wanted.get<std::string>() : wanted.dump();
    int major = 0;
    int minor = 0;
    const char* end = text.data() + text.size();
    const auto [dot, first] = std::from_chars(text.data(), end, major);
    const bool good =
        first == std::errc() && dot != end && *dot == '.' && std::from_chars(dot + 1, end, minor).ec == std::errc();
    if (good && (major < 2 || (major == 2 && minor == 0))) return;
    refuse(ErrorCode::unsupported, "asks for glTF '{:.20}' or newer (asset.minVersion); 2.0 is supported", text);
}

/// Changes unknown media types to that of plain bytes; the content identifies itself. Returns whether it did.
bool checkDataUri(const std::string& path, json& object) {
    constexpr std::string_view kScheme = "data:";
    constexpr std::string_view kMark = ";base64,";
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=";
    constexpr std::array<std::string_view, 5> kKnown{"application/octet-stream", "application/gltf-buffer",
                                                     "image/jpeg", "image/png", "text/plain"};
    const auto uri = object.find("uri");
    if (uri == object.end() || !uri->is_string()) return false;
    const auto& text = uri->get_ref<const std::string&>();
    if (!text.starts_with(kScheme)) return false;
    const std::size_t comma = text.find(',');
    const std::size_t mark = text.find(kMark);
    if (comma == std::string::npos || mark == std::string::npos || mark + kMark.size() - 1 != comma) {
        refuse(ErrorCode::unsupported,
               "{}: its data: URI is percent-encoded text, and only base64 is supported; save the scene as .glb", path);
    }
    const std::string_view data = std::string_view(text).substr(comma + 1);
    if (data.empty()) refuseMalformed("{}: its data: URI holds no data", path);
    if (const std::size_t at = data.find_first_not_of(kDigits); at != std::string_view::npos) {
        refuseMalformed("{}: its data: URI is not base64 from byte {} on; save the scene as .glb", path, at);
    }
    if (contains(kKnown, std::string_view(text).substr(kScheme.size(), mark - kScheme.size()))) return false;
    *uri = std::string("data:application/octet-stream;base64,").append(data);
    return true;
}

}  // namespace

bool checkStrictly(json& root) {
    checkVersion(root);
    bool changed = false;
    for (auto& [name, list] : root.items()) {
        if (!list.is_array()) continue;
        std::size_t number = 0;
        for (json& element : list) {
            const std::string path = fmt::format("{} {}", name, number++);
            checkNumbers(path, element);
            if ((name == "buffers" || name == "images") && element.is_object()) changed |= checkDataUri(path, element);
        }
    }
    return changed;
}

}  // namespace probegi::io
