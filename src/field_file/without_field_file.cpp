#include "probegi/field_file.h"

namespace probegi {

namespace {

Error withoutFiles() {
    return fail(ErrorCode::unsupported,
                "this ProbeGI was built without file formats; build it with PROBEGI_IO=ON, or keep Field::read() with "
                "code of your own");
}

}  // namespace

Result<SceneFingerprint> fingerprintOf(const Scene&, const ScenePose&, const Lighting&) {
    return withoutFiles();
}
Result<void> saveField(const std::filesystem::path&, const SavedField&) {
    return withoutFiles();
}
Result<void> saveField(const std::filesystem::path&, const Field&, const FieldProvenance&) {
    return withoutFiles();
}
Result<SavedField> loadField(const std::filesystem::path&, const ReadLimits&) {
    return withoutFiles();
}
bool isFieldFile(const std::filesystem::path&) noexcept {
    return false;
}
Result<Field> restoreField(const Backend&, const SavedField&) {
    return withoutFiles();
}

}  // namespace probegi
