#include "source_folder.h"

namespace probegi::test {

std::filesystem::path sourceFolder() {
    return PROBEGI_SOURCE_FOLDER;
}

}  // namespace probegi::test
