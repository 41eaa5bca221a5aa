#include "saved_field.h"

#include <fmt/format.h>

namespace probegi::tool {

namespace {

bool sameDesc(const FieldDesc& a, const FieldDesc& b) {
    return a.volumes == b.volumes && a.raysPerProbe == b.raysPerProbe && a.fixedRays == b.fixedRays &&
           a.irradianceTexels == b.irradianceTexels && a.visibilityTexels == b.visibilityTexels && a.rules == b.rules &&
           a.emitterSamples == b.emitterSamples && a.relocation == b.relocation && a.probeStates == b.probeStates &&
           a.seed == b.seed;
}

VolumeDesc standing(const FieldSnapshot& snapshot, std::size_t volume) {
    VolumeDesc v = snapshot.desc.volumes[volume];
    v.origin += v.orientation * (glm::vec3(snapshot.scrolled[volume]) * v.spacing);
    return v;
}

}  // namespace

bool sameSettings(const FieldDesc& aDesc, FieldSettings a, const FieldDesc& bDesc, const FieldSettings& b) {
    a.guard = b.guard, a.masks = b.masks;
    return sameDesc(aDesc, bDesc) && a == b;
}

void addFieldOption(CLI::App& command, RenderOptions& options) {
    auto* field = command
                      .add_option("--field", options.field,
                                  "probes from a file of 'probegi bake', masks included, in place of filling them; its "
                                  "leak guard stays, but for --leak-guard sdf-shadow; "
                                  "with --frames or --tolerance they are updated from there")
                      ->type_name("FILE")
                      ->group("Probes");
    for (const char* other : {"--probes", "--volume", "--cascades", "--outside", "--rules", "--rays", "--relocation",
                              "--probe-states", "--clusters", "--mask-factor", "--mask-strict"})
        field->excludes(command.get_option(other));
}

Result<std::optional<SavedField>> readSavedField(RenderOptions& options) {
    if (options.field.empty()) return std::nullopt;
    auto saved = loadField(options.field, options.scene.limits);
    if (!saved) return fail(saved.error().code, fmt::format("--field {}", saved.error().message));
    for (std::size_t i = 0; i < saved->snapshot.desc.volumes.size(); ++i)
        options.scene.given.push_back(standing(saved->snapshot, i));
    return std::move(*saved);
}

Result<void> warnOfOtherScene(const SavedField& saved, const LoadedSetup& setup, bool updates) {
    const SceneFingerprint baked = saved.provenance.fingerprint;
    const auto here = fingerprintOf(*setup.scene, setup.pose, setup.lighting);
    if (!here) return here.error();
    if (baked.geometry != 0 && baked.geometry != here->geometry)
        printWarning(
            fmt::format("the field was baked for another scene or moment ('{}'): its probes and masks may not "
                        "fit this one; bake it again",
                        plainText(saved.provenance.scene, kShownName)));
    else if (baked.light != 0 && baked.light != here->light && !updates)
        printWarning(
            "the field was baked with other lights or materials, and keeps their light; --frames N lets it follow");
    return {};
}

Result<Field> openSavedField(const Backend& backend, const SavedField& saved, Method method) {
    if (method != Method::leaky) return restoreField(backend, saved);
    SavedField leaky = saved;
    leaky.settings.guard = LeakGuard::none;
    return restoreField(backend, leaky);
}

bool updatesSaved(const RenderOptions& options) {
    return options.run.frames || options.run.tolerance;
}

}  // namespace probegi::tool
