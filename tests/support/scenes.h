#pragma once

#include <cstdlib>
#include <filesystem>

#include "source_folder.h"

namespace probegi::test {

/// Folder of the real scenes: the environment variable PROBEGI_SCENES, else ../shared/scenes beside the checkout.
inline std::filesystem::path scenesFolder() {
    if (const char* folder = std::getenv("PROBEGI_SCENES"); folder && *folder) return folder;
    return sourceFolder() / ".." / "shared" / "scenes";
}

}  // namespace probegi::test
