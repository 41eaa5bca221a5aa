#include <sstream>

#include "io/file_bytes.h"
#include "io/gltf.h"
#include "io/harness_ini.h"
#include "io/refused.h"
#include "probegi/io.h"

namespace probegi {

using namespace io;

namespace {

/// Settings beside the scene, if there are any.
Result<void> addSettings(std::filesystem::path path, Scene& scene) {
    path.replace_extension(".ini");
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return {};
    return guarded(path.string(), [&] {
        constexpr std::uint64_t kMaxBytes = 1 << 20;
        const std::vector<std::uint8_t> bytes = readFile(path, kMaxBytes);
        std::istringstream stream(std::string(bytes.begin(), bytes.end()));
        addHarnessSettings(stream, scene);
    });
}

}  // namespace

Result<LoadedScene> loadScene(const std::filesystem::path& path) {
    Result<LoadedScene> loaded = guarded(path.string(), [&] {
        const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
        return importGltf(readFile(path), folder);
    });
    if (!loaded) return loaded;
    if (const auto added = addSettings(path, loaded->scene); !added) return tl::unexpected(added.error());
    if (loaded->scene.name.empty()) loaded->scene.name = path.stem().string();
    const auto valid = validate(loaded->scene);
    if (!valid) return fail(valid.error().code, fmt::format("{}: {}", path.string(), valid.error().message));
    return loaded;
}

}  // namespace probegi
