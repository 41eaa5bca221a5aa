#include "render_options.h"

#include "console/parse.h"

namespace probegi::tool {

FieldSettings fieldSettings(const LoadedSetup& setup, Method method, FieldRules rules) {
    FieldSettings settings = setup.settings;
    if (rules == FieldRules::paper) settings.visibilityExponent = kPaperVisibilityExponent;
    settings.guard = method == Method::leaky ? LeakGuard::none : LeakGuard::moments;
    return settings;
}

bool hasProbes(const RenderOptions& options) {
    return options.method != Method::none && (options.method != Method::reference || options.guide);
}

PictureDesc pictureDesc(const RenderOptions& options, const LoadedSetup& setup) {
    const PictureSize size = *parseSize(options.size);
    return {setup.camera, size.width, size.height, options.antialias, options.diffuseOnly, options.glossy};
}

Result<std::optional<Field>> makeEmptyField(const Backend& backend, const LoadedSetup& setup,
                                            const RenderOptions& options) {
    if (!hasProbes(options)) return std::nullopt;
    FieldDesc desc;
    desc.volumes = setup.volumes;
    desc.raysPerProbe = options.rays;
    desc.seed = options.seed;
    desc.rules = options.rules;
    desc.relocation = options.relocation;
    desc.probeStates = options.probeStates;
    auto field = backend.makeField(desc, fieldSettings(setup, options.method, options.rules));
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
