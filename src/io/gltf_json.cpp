#include "io/gltf_json.h"

#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/gltf_strict.h"
#include "io/json_text.h"

namespace probegi::io {

namespace {

using nlohmann::json;
using Bytes = std::span<const std::uint8_t>;

// Binary glTF: a header of magic, version and length, then chunks of length, type and bytes; the first is the JSON
// (glTF 2.0, section 4.4).
constexpr std::size_t kLengthAt = 8;
constexpr std::size_t kJsonLengthAt = 12;
constexpr std::size_t kJsonAt = 20;

std::uint32_t wordAt(Bytes bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof(word));
    return word;
}

Bytes jsonOf(Bytes bytes) {
    if (!isBinaryGltf(bytes)) return bytes;
    if (bytes.size() < kJsonAt) refuseMalformed("ends within the header of binary glTF");
    const std::uint32_t version = wordAt(bytes, 4);
    if (version != 2) refuse(ErrorCode::unsupported, "is binary glTF version {}; only 2 is supported", version);
    const std::size_t length = wordAt(bytes, kJsonLengthAt);
    if (length > bytes.size() - kJsonAt) refuseMalformed("ends before its JSON does; the file is cut off");
    return bytes.subspan(kJsonAt, length);
}

/// The elements of an array member; none if it is missing or of another type (tinygltf reports that later).
const json& arrayOf(const json& object, const char* member) {
    static const json kNone = json::array();
    const auto found = object.find(member);
    return found != object.end() && found->is_array() ? *found : kNone;
}

std::optional<std::uint64_t> unsignedOf(const json& object, const char* member) {
    if (!object.is_object()) return {};
    const auto found = object.find(member);
    if (found == object.end() || !found->is_number_unsigned()) return {};
    return found->get<std::uint64_t>();
}

/// tinygltf copies the binary chunk into every buffer without a uri; only the first may lack one.
void checkBuffers(const json& root) {
    bool first = true;
    for (const json& buffer : arrayOf(root, "buffers")) {
        const bool embedded = buffer.is_object() && !buffer.contains("uri");
        if (embedded && !first) refuseMalformed("a buffer after the first has no uri");
        first = false;
    }
}

/// tinygltf takes the address of an image's first byte before checking sizes.
void checkImages(const json& root) {
    const json& views = arrayOf(root, "bufferViews");
    const json& buffers = arrayOf(root, "buffers");
    std::size_t number = 0;
    for (const json& image : arrayOf(root, "images")) {
        const std::size_t index = number++;
        if (!image.is_object() || !image.contains("bufferView")) continue;
        const auto view = unsignedOf(image, "bufferView");
        if (!view || *view >= views.size()) refuseMalformed("image {} uses a buffer view that does not exist", index);
        const auto buffer = unsignedOf(views[*view], "buffer");
        if (!buffer || *buffer >= buffers.size()) {
            refuseMalformed("buffer view {} uses a buffer that does not exist", *view);
        }
        const std::uint64_t size = unsignedOf(buffers[*buffer], "byteLength").value_or(0);
        const std::uint64_t offset = unsignedOf(views[*view], "byteOffset").value_or(0);
        const std::uint64_t length = unsignedOf(views[*view], "byteLength").value_or(0);
        if (length == 0 || offset > size || length > size - offset) {
            refuseMalformed("image {} reaches beyond the end of its buffer", index);
        }
    }
}

bool isCompressed(const json& primitive) {
    if (!primitive.is_object()) return false;
    const auto extensions = primitive.find("extensions");
    return extensions != primitive.end() && extensions->is_object() &&
           extensions->contains("KHR_draco_mesh_compression");
}

/// Drops indices that Draco stores itself. Returns whether there were any.
bool dropCompressedIndices(json& root) {
    bool dropped = false;
    if (arrayOf(root, "meshes").empty()) return false;
    for (json& mesh : root["meshes"]) {
        if (!mesh.is_object() || arrayOf(mesh, "primitives").empty()) continue;
        for (json& primitive : mesh["primitives"]) {
            if (isCompressed(primitive)) dropped |= primitive.erase("indices") > 0;
        }
    }
    return dropped;
}

void putWord(std::vector<std::uint8_t>& bytes, std::size_t at, std::size_t value) {
    const auto word = std::uint32_t(value);
    std::memcpy(bytes.data() + at, &word, sizeof(word));
}

/// The file with its JSON replaced.
std::vector<std::uint8_t> replaceJson(Bytes bytes, const json& root) {
    std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
    if (!isBinaryGltf(bytes)) return {text.begin(), text.end()};
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const Bytes rest = bytes.subspan(kJsonAt + jsonOf(bytes).size());
    std::vector<std::uint8_t> out(bytes.begin(), bytes.begin() + kJsonAt);
    out.insert(out.end(), text.begin(), text.end());
    out.insert(out.end(), rest.begin(), rest.end());
    putWord(out, kLengthAt, out.size());
    putWord(out, kJsonLengthAt, text.size());
    return out;
}

}  // namespace

bool isBinaryGltf(Bytes bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

Bytes prepareGltf(Bytes bytes, Budget& budget, std::vector<std::uint8_t>& storage) {
    json root = parseJsonText(jsonOf(bytes), budget);
    bool changed = checkStrictly(root);
    checkBuffers(root);
    checkImages(root);
    changed |= dropCompressedIndices(root);
    if (!changed) return bytes;
    storage = replaceJson(bytes, root);
    return storage;
}

}  // namespace probegi::io
