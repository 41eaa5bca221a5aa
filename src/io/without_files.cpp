#include "probegi/image.h"
#include "probegi/io.h"

namespace probegi {

namespace {

Error withoutFiles() {
    return fail(ErrorCode::unsupported,
                "this ProbeGI was built without file formats; build it with PROBEGI_IO=ON, or read and write files "
                "with code of your own");
}

}  // namespace

Result<LoadedScene> loadScene(const std::filesystem::path&) {
    return withoutFiles();
}
Result<HdrImage> readImage(const std::filesystem::path&) {
    return withoutFiles();
}
Result<void> writeImage(const std::filesystem::path&, const HdrImage&, const ToneMap&) {
    return withoutFiles();
}

}  // namespace probegi
