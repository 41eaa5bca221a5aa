#include "io/gltf_parse.h"

#include <algorithm>
#include <array>

#include "io/file_bytes.h"
#include "io/gltf_json.h"
#include "scene/checks.h"

namespace probegi::io {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 5> kSupported{
    "KHR_draco_mesh_compression", "KHR_lights_punctual",   "KHR_materials_emissive_strength",
    "KHR_mesh_quantization",      "KHR_texture_transform",
};

bool supported(const std::string& extension) {
    return std::find(kSupported.begin(), kSupported.end(), extension) != kSupported.end();
}

/// Where external files may be, and how many more bytes of them may be read.
struct Neighbours {
    fs::path folder;
    std::vector<fs::path>& read;
    std::uint64_t bytesLeft = 0xffffffffu;
};

/// A file may refer to files in its own folder or below, and nothing else on this or any other machine.
fs::path resolve(const Neighbours& neighbours, const std::string& uri) {
    const fs::path relative(uri);
    const bool leaves =
        std::any_of(relative.begin(), relative.end(), [](const fs::path& part) { return part == ".."; });
    if (uri.find("://") != std::string::npos || relative.is_absolute() || leaves ||
        uri.find('\\') != std::string::npos || uri.find('\0') != std::string::npos) {
        refuse(ErrorCode::unsupported, "refers to '{}'; only files in its own folder or below are read",
               checks::quotable(uri));
    }
    if (neighbours.folder.empty()) {
        refuse(ErrorCode::unsupported, "refers to the file '{}', but was not read from a folder",
               checks::quotable(uri));
    }
    return neighbours.folder / relative;
}

bool fileExists(const std::string& uri, void* user) {
    std::error_code error;
    if (!fs::exists(resolve(*static_cast<Neighbours*>(user), uri), error)) {
        refuse(ErrorCode::fileNotFound, "needs the file '{}', which is missing; put it beside the scene",
               checks::quotable(uri));
    }
    return true;
}

std::string sameName(const std::string& uri, void*) {
    return uri;
}

bool readNeighbour(std::vector<unsigned char>* out, std::string*, const std::string& uri, void* user) {
    auto& neighbours = *static_cast<Neighbours*>(user);
    try {
        const fs::path path = resolve(neighbours, uri);
        *out = readFile(path, neighbours.bytesLeft);
        if (out->empty()) refuseMalformed("is empty");
        neighbours.read.push_back(path);
    } catch (const Refused& refused) {
        refuse(refused.error.code, "needs the file '{}', which {}", checks::quotable(uri), refused.error.message);
    }
    neighbours.bytesLeft -= out->size();
    return true;
}

bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

/// Images are decoded later, once, and only if a material uses them; those in a buffer view stay there.
bool keepEncoded(tinygltf::Image* image, int index, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
    if (image->bufferView >= 0) return true;
    if (size < 0) refuse(ErrorCode::outOfMemory, "image {} is larger than 2 GiB", index);
    image->image.assign(bytes, bytes + size);
    return true;
}

/// tinygltf's messages contain line breaks; ours are one sentence.
std::string oneLine(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    constexpr std::size_t kMaxLength = 300;  // it may quote a whole data URI
    if (text.size() > kMaxLength) text = text.substr(0, kMaxLength) + "...";
    return text;
}

void checkExtensions(const tinygltf::Model& model, std::vector<std::string>& warnings) {
    for (const std::string& extension : model.extensionsRequired) {
        if (!supported(extension)) {
            refuse(ErrorCode::unsupported, "requires the glTF extension {}, which is not supported; export without it",
                   checks::quotable(extension));
        }
    }
    for (const std::string& extension : model.extensionsUsed) {
        if (!supported(extension)) {
            warnings.push_back(fmt::format("the optional glTF extension {} is not supported and is ignored",
                                           checks::quotable(extension)));
        }
    }
}

/// tinygltf's model, unchecked.
tinygltf::Model load(tinygltf::TinyGLTF& reader, std::span<const std::uint8_t> bytes, std::string& warning) try {
    tinygltf::Model model;
    std::string error;
    const auto size = unsigned(bytes.size());
    const bool good = isBinaryGltf(bytes)
                          ? reader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, "")
                          : reader.LoadASCIIFromString(&model, &error, &warning,
                                                       reinterpret_cast<const char*>(bytes.data()), size, "");
    if (!good) refuseMalformed("is not valid glTF: {}", error.empty() ? "damaged" : oneLine(std::move(error)));
    return model;
} catch (const std::bad_alloc&) {
    throw;
} catch (const std::exception&) {  // it accesses missing JSON members
    refuseMalformed("is not valid glTF: a value is missing or of the wrong kind; export it again");
}

}  // namespace

tinygltf::Model parseGltf(std::span<const std::uint8_t> bytes, const fs::path& folder, const ReadLimits& limits,
                          LoadedScene& out) {
    std::vector<std::uint8_t> storage;
    Budget budget(limits, bytes.size(), kGeometryShare);
    bytes = prepareGltf(bytes, budget, storage);
    Neighbours neighbours{folder, out.files};
    tinygltf::TinyGLTF reader;
    reader.SetFsCallbacks({fileExists, sameName, readNeighbour, writeNothing, &neighbours});
    reader.SetImageLoader(keepEncoded, nullptr);
    std::string warning;
    tinygltf::Model model = load(reader, bytes, warning);
    if (!model.asset.version.starts_with("2.")) {
        refuse(ErrorCode::unsupported, "is glTF version '{}'; only 2 is supported", oneLine(model.asset.version));
    }
    if (!warning.empty()) out.warnings.push_back(oneLine(std::move(warning)));
    checkExtensions(model, out.warnings);
    return model;
}

}  // namespace probegi::io
