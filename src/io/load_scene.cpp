#include <sstream>

#include "io/file_bytes.h"
#include "io/gltf.h"
#include "io/harness_ini.h"
#include "io/refused.h"
#include "probegi/io.h"

namespace probegi {

using namespace io;

namespace {

/// Settings beside the scene, if there are any. Returns what of them is ignored, one sentence each.
Result<std::vector<std::string>> addSettings(std::filesystem::path path, Scene& scene) {
    path.replace_extension(".ini");
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return std::vector<std::string>();
    return guarded(path.string(), [&] {
        constexpr std::uint64_t kMaxBytes = 1 << 20;
        const std::vector<std::uint8_t> bytes = readFile(path, kMaxBytes);
        std::istringstream stream(std::string(bytes.begin(), bytes.end()));
        std::vector<std::string> ignored = addHarnessSettings(stream, scene);
        for (std::string& sentence : ignored) sentence = fmt::format("{}: {}", path.string(), sentence);
        return ignored;
    });
}

}  // namespace

Result<LoadedScene> loadScene(const std::filesystem::path& path) {
    Result<LoadedScene> loaded = guarded(path.string(), [&] {
        const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
        return importGltf(readFile(path), folder);
    });
    if (!loaded) return loaded;
    const auto ignored = addSettings(path, loaded->scene);
    if (!ignored) return ignored.error();
    loaded->warnings.insert(loaded->warnings.end(), ignored->begin(), ignored->end());
    if (loaded->scene.name.empty()) loaded->scene.name = path.stem().string();
    const auto valid = validate(loaded->scene);
    if (!valid) return fail(valid.error().code, fmt::format("{}: {}", path.string(), valid.error().message));
    return loaded;
}

}  // namespace probegi
