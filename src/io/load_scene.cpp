#include <sstream>

#include "io/file_bytes.h"
#include "io/gltf.h"
#include "io/harness_ini.h"
#include "io/refused.h"
#include "probegi/io.h"
#include "scene/recentre.h"

namespace probegi {

using namespace io;

namespace {

/// validate(), with the file's name in the error.
Result<void> validateFrom(const std::filesystem::path& path, const Scene& scene) {
    const auto valid = validate(scene);
    if (valid) return {};
    return fail(valid.error().code, fmt::format("{}: {}", path.string(), valid.error().message));
}

/// Adds the settings beside the scene, if any, and a warning for each ignored one.
Result<void> addSettings(std::filesystem::path path, LoadedScene& loaded) {
    path.replace_extension(".ini");
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return {};
    const auto ignored = guarded(path.string(), [&] {
        constexpr std::uint64_t kMaxBytes = 1 << 20;
        const std::vector<std::uint8_t> bytes = readFile(path, kMaxBytes);
        std::istringstream stream(std::string(bytes.begin(), bytes.end()));
        return addHarnessSettings(stream, loaded.scene);
    });
    if (!ignored) return ignored.error();
    loaded.files.push_back(path);
    for (const std::string& sentence : *ignored)
        loaded.warnings.push_back(fmt::format("{}: {}", path.string(), sentence));
    return validateFrom(path, loaded.scene);
}

}  // namespace

Result<LoadedScene> loadScene(const std::filesystem::path& path, const ReadLimits& limits) {
    Result<LoadedScene> loaded = guarded(path.string(), [&] {
        const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
        LoadedScene read = importGltf(readFile(path), folder, limits);
        read.files.push_back(path);
        return read;
    });
    if (!loaded) return loaded;
    if (const auto valid = validateFrom(path, loaded->scene); !valid) return valid.error();
    if (const auto added = addSettings(path, *loaded); !added) return added.error();
    if (recentre(loaded->scene))
        loaded->warnings.push_back(fmt::format(
            "{}: the scene is far from the origin, where coordinates are too coarse; its origin is moved to "
            "({:g}, {:g}, {:g}) m (Scene::origin)",
            path.string(), loaded->scene.origin.x, loaded->scene.origin.y, loaded->scene.origin.z));
    if (loaded->scene.name.empty()) loaded->scene.name = path.stem().string();
    return loaded;
}

}  // namespace probegi
