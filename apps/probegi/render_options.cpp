#include "render_options.h"

#include <map>

#include "console/parse.h"
#include "sdf_scene.h"

namespace probegi::tool {

FieldSettings fieldSettings(const LoadedSetup& setup, Method method, FieldRules rules) {
    FieldSettings settings = setup.settings;
    if (rules == FieldRules::paper) settings.visibilityExponent = kPaperVisibilityExponent;
    settings.guard = method == Method::leaky ? LeakGuard::none : LeakGuard::moments;
    return settings;
}

void addProbeOptions(CLI::App& command, RenderOptions& options) {
    static const std::map<std::string, FieldRules> kRules{{"measured", FieldRules::measured},
                                                          {"paper", FieldRules::paper}};
    command
        .add_option("--rules", options.rules,
                    "the field's rules: those that measured closest to the path tracer (measured, the default), or "
                    "exactly the DDGI paper's (paper)")
        ->type_name("measured|paper")
        ->transform(oneOf(kRules));
    command.add_option("--rays", options.rays, "rays per probe and update, 8 to 4096")
        ->type_name("N")
        ->check(inRange(8, 4096))
        ->capture_default_str();
    command
        .add_option("--relocation", options.relocation,
                    "probes leave walls and keep a distance from surfaces (default off)")
        ->type_name("on|off")
        ->transform(oneOf(kOnOff));
    command
        .add_option("--probe-states", options.probeStates,
                    "do not update probes in the open air and in walls, which no surface uses: a third faster in rooms "
                    "(default off)")
        ->type_name("on|off")
        ->transform(oneOf(kOnOff));
}

bool hasProbes(const RenderOptions& options) {
    return options.method != Method::none && (options.method != Method::reference || options.guide);
}

PictureDesc pictureDesc(const RenderOptions& options, const LoadedSetup& setup) {
    const PictureSize size = *parseSize(options.size);
    return {setup.camera,        size.width,     size.height,    options.antialias,
            options.diffuseOnly, options.glossy, options.contact};
}

Result<std::optional<Field>> makeEmptyField(const Backend& backend, const LoadedSetup& setup,
                                            const RenderOptions& options, const ScenePose& pose) {
    if (!hasProbes(options)) return std::nullopt;
    FieldDesc desc;
    desc.volumes = setup.volumes;
    desc.raysPerProbe = options.rays;
    desc.seed = options.seed;
    desc.rules = options.rules;
    desc.relocation = options.relocation;
    desc.probeStates = options.probeStates;
    FieldSettings settings = fieldSettings(setup, options.method, options.rules);
    if (options.masks.guard == LeakGuard::sdfShadow) settings.guard = LeakGuard::sdfShadow;
    if (auto placed = placeGuard(settings, setup, pose); !placed) return placed.error();
    auto field = backend.makeField(desc, settings);
    if (!field) return field.error();
    if (auto set = setBudget(*field, setup, options); !set) return set.error();
    return std::move(*field);
}

Result<void> setBudget(Field& field, const LoadedSetup& setup, const RenderOptions& options) {
    if (options.budget.empty()) return {};
    auto budget = parseBudget(options.budget);
    if (!budget) return budget.error();
    const PictureDesc picture = pictureDesc(options, setup);
    budget->view = {setup.camera, float(picture.width) / float(picture.height)};
    return field.control().setBudget(*budget);
}

Result<ReferencePicture> renderReference(const Context& context, const Tracer& tracer, const LoadedSetup& setup,
                                         const RenderOptions& options, const Field* guide) {
    const auto pathTracer = PathTracer::create(context, *setup.scene, setup.pose, tracer, setup.lighting);
    if (!pathTracer) return pathTracer.error();
    ReferenceDesc desc;
    desc.picture = pictureDesc(options, setup);
    desc.seconds = options.seconds.value_or(0);
    desc.samplesPerPixel = options.samplesPerPixel.value_or(options.seconds ? 0 : kDefaultReferenceSamples);
    desc.seed = options.seed;
    desc.guide = guide;
    return pathTracer->render(desc);
}

}  // namespace probegi::tool
