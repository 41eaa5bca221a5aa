#include "probegi/image.h"
#include "probegi/io.h"
#include "probegi/sdf.h"

namespace probegi {

namespace {

Error withoutFiles() {
    return fail(ErrorCode::unsupported,
                "this ProbeGI was built without file formats; build it with PROBEGI_IO=ON, or read and write files "
                "with code of your own");
}

}  // namespace

Result<LoadedScene> loadScene(const std::filesystem::path&, const ReadLimits&) {
    return withoutFiles();
}
Result<HdrImage> readImage(const std::filesystem::path&, const ReadLimits&) {
    return withoutFiles();
}
Result<void> writeImage(const std::filesystem::path&, const HdrImage&, const ToneMap&) {
    return withoutFiles();
}
Result<SdfScene> loadSdf(const std::filesystem::path&, const ReadLimits&) {
    return withoutFiles();
}
Result<void> saveSdf(const std::filesystem::path&, const SdfScene&) {
    return withoutFiles();
}

Result<void> writeFile(const std::filesystem::path&, std::span<const std::uint8_t>) {
    return withoutFiles();
}
Result<void> checkWritable(const std::filesystem::path&) {
    return withoutFiles();
}

}  // namespace probegi
