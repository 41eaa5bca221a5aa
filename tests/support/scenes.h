#pragma once

#include <cstdlib>
#include <filesystem>

namespace probegi::test {

/// Folder of the real scenes: the environment variable PROBEGI_SCENES, else ../shared/scenes beside the checkout.
inline std::filesystem::path scenesFolder() {
    if (const char* folder = std::getenv("PROBEGI_SCENES"); folder && *folder) return folder;
    return std::filesystem::path(PROBEGI_SOURCE_DIR) / ".." / "shared" / "scenes";
}

}  // namespace probegi::test
