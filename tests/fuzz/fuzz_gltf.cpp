// Any bytes as a glTF file, and as the settings beside one: a scene or an error message, never a crash.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "io/gltf.h"
#include "io/harness_ini.h"
#include "io/refused.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace probegi;
    constexpr std::uint8_t kSettings = '#';  // seeds of settings begin with a comment
    if (size > 0 && data[0] == kSettings) {
        (void)io::guarded("settings", [&] {
            std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
            Scene scene;
            io::addHarnessSettings(stream, scene);
        });
        return 0;
    }
    const auto loaded = io::loadGltfFromMemory("scene", {data, size}, {});
    if (loaded) (void)poseAt(loaded->scene, 0.5f);
    return 0;
}
