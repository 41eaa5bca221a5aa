#include "report_render.h"

#include <chrono>
#include <glm/common.hpp>
#include <random>
#include <tuple>

#include "render_stats.h"

namespace probegi::tool {

namespace {

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count(); }

private:
    std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

PictureDesc pictureDesc(const LoadedSetup& setup, const ReportSettings& settings) {
    PictureDesc desc;
    desc.camera = setup.camera;
    desc.width = settings.width;
    desc.height = settings.height;
    desc.diffuseOnly = settings.diffuseOnly;
    return desc;
}

/// Mean standard error over mean value, over all pixels and channels.
double relativeNoise(const ReferencePicture& reference) {
    double error = 0;
    double value = 0;
    for (std::size_t i = 0; i < reference.standardError.pixels.size(); ++i) {
        const glm::vec3 e = reference.standardError.pixels[i];
        const glm::vec3 v = reference.picture.color.pixels[i];
        error += double(e.x) + e.y + e.z;
        value += double(v.x) + v.y + v.z;
    }
    return value > 0 ? error / value : 0;
}

/// What a layer of the reference scores against itself with as much noise again as its standard error says it has.
Result<ImageDifference> noiseScore(const HdrImage& layer, const HdrImage& standardError, std::uint64_t seed,
                                   float exposure) {
    std::mt19937_64 random(seed);
    std::normal_distribution<float> normal;
    HdrImage twin = layer;
    for (std::size_t i = 0; i < twin.pixels.size(); ++i)
        twin.pixels[i] = glm::max(twin.pixels[i] + standardError.pixels[i] * normal(random), 0.0f);
    const auto compared = compareImages(twin, layer, {exposure});
    if (!compared) return compared.error();
    return compared->difference;
}

Result<FieldResult> fillField(Field& field, const Tracer& tracer, const Lighting& lighting,
                              const FieldRunOptions& options) {
    FieldResult result;
    const Stopwatch watch;
    auto run = runField(field, tracer, lighting, options);
    if (!run) return run.error();
    result.seconds = watch.seconds();
    result.run = std::move(*run);
    result.description = describeRun(result.run, options);
    result.update = medianTimes(result.run.updates);
    result.memory = field.memory();
    return result;
}

Result<MethodResult> drawMethod(const Backend& backend, const Tracer& tracer, const LoadedSetup& setup,
                                const ReportSettings& settings, const Field* field) {
    auto rendered = backend.render(tracer, setup.lighting, field, pictureDesc(setup, settings));
    if (!rendered) return rendered.error();
    MethodResult result;
    result.picture = std::move(rendered->picture);
    result.pictureMs = rendered->times.total;
    return result;
}

Result<void> judge(MethodResult& method, const Picture& reference, const ToneMap& toneMap) {
    auto whole = compareImages(method.picture.color, reference.color, toneMap);
    if (!whole) return whole.error();
    const auto indirect = compareImages(method.picture.indirect, reference.indirect, toneMap);
    if (!indirect) return indirect.error();
    method.whole = std::move(*whole);
    method.indirectOnly = indirect->difference;
    return {};
}

Result<FieldPicture> drawField(const Backend& backend, const Tracer& tracer, const LoadedSetup& setup,
                               const ReportSettings& settings, const ProbeTruth& truth, Field& field,
                               const FieldRunOptions& run) {
    auto filled = fillField(field, tracer, setup.lighting, run);
    if (!filled) return filled.error();
    filled->ratio = percentiles(probeRatios(field, truth));
    auto drawn = drawMethod(backend, tracer, setup, settings, &field);
    if (!drawn) return drawn.error();
    return FieldPicture{std::move(*filled), std::move(*drawn)};
}

FieldDesc fieldDesc(const LoadedSetup& setup, const ReportSettings& settings) {
    FieldDesc desc;
    desc.grid = setup.grid;
    desc.raysPerProbe = settings.raysPerProbe;
    desc.seed = settings.seed;
    return desc;
}

/// The field without and with its leak guard. The second run starts from the first one's light, which it forgets. The
/// field comes back for whoever wants to be guided by it.
Result<Field> drawFields(const Backend& backend, const Tracer& tracer, const LoadedSetup& setup,
                         const ReportSettings& settings, RenderedScene& scene) {
    auto field = backend.makeField(fieldDesc(setup, settings));
    if (!field) return field.error();
    for (const auto& [guard, result, method] : {std::tuple(LeakGuard::none, &scene.leakyField, &scene.leaky),
                                                std::tuple(LeakGuard::moments, &scene.ddgiField, &scene.ddgi)}) {
        field->setGuard(guard);
        auto drawn = drawField(backend, tracer, setup, settings, scene.truth, *field, settings.run);
        if (!drawn) return drawn.error();
        *result = std::move(drawn->field);
        *method = std::move(drawn->method);
    }
    if (!settings.realtimeUpdates) return std::move(*field);
    auto fresh = backend.makeField(fieldDesc(setup, settings));
    if (!fresh) return fresh.error();
    auto drawn = drawField(backend, tracer, setup, settings, scene.truth, *fresh, {settings.realtimeUpdates, {}});
    if (!drawn) return drawn.error();
    scene.realtime = std::move(*drawn);
    return std::move(*field);
}

Result<void> drawReference(const PathTracer& pathTracer, const LoadedSetup& setup, const ReportSettings& settings,
                           const Field& guide, RenderedScene& scene) {
    ReferenceDesc desc;
    desc.guide = &guide;
    desc.picture = pictureDesc(setup, settings);
    desc.seconds = settings.seconds;
    desc.samplesPerPixel = settings.samplesPerPixel;
    desc.seed = settings.seed;
    auto reference = pathTracer.render(desc);
    if (!reference) return reference.error();
    scene.referenceSamples = reference->samplesPerPixel;
    scene.referenceSeconds = reference->seconds;
    scene.referenceNoise = relativeNoise(*reference);
    const Picture& truth = reference->picture;
    const auto whole = noiseScore(truth.color, reference->standardError, settings.seed, setup.exposure);
    if (!whole) return whole.error();
    scene.noiseFloor = *whole;
    HdrImage indirectError = reference->standardError;
    for (std::size_t i = 0; i < indirectError.pixels.size(); ++i)
        indirectError.pixels[i] = glm::min(indirectError.pixels[i], truth.indirect.pixels[i]);
    const auto indirect = noiseScore(truth.indirect, indirectError, settings.seed, setup.exposure);
    if (!indirect) return indirect.error();
    scene.indirectNoiseFloor = *indirect;
    scene.reference = std::move(reference->picture);
    return {};
}

}  // namespace

Result<RenderedScene> renderForReport(const Context& context, const Backend& backend, const LoadedSetup& setup,
                                      const ReportSettings& settings) {
    RenderedScene scene;
    scene.triangles = triangleCount(*setup.scene, setup.pose);
    scene.lights = setup.lighting.lights.size();
    scene.grid = setup.grid;
    const Stopwatch watch;
    const auto tracer = makeEmbreeTracer(context, *setup.scene, setup.pose);
    if (!tracer) return tracer.error();
    const auto pathTracer = PathTracer::create(context, *setup.scene, setup.pose, **tracer, setup.lighting);
    if (!pathTracer) return pathTracer.error();
    scene.prepareSeconds = watch.seconds();
    std::unique_ptr<Tracer> another;  // where the reference's is not the backend's
    if (backend.kind() != BackendKind::cpu) {
        auto made = backend.makeTracer(*setup.scene, setup.pose);
        if (!made) return made.error();
        another = std::move(*made);
    }
    const Tracer& drawing = another ? *another : **tracer;

    auto truth = traceProbeTruth(**tracer, *pathTracer, setup.grid, settings.ratioProbes, settings.ratioSamples,
                                 settings.diffuseOnly);
    if (!truth) return truth.error();
    scene.truth = std::move(*truth);
    auto none = drawMethod(backend, drawing, setup, settings, nullptr);
    if (!none) return none.error();
    scene.none = std::move(*none);
    const auto field = drawFields(backend, drawing, setup, settings, scene);
    if (!field) return field.error();
    if (auto done = drawReference(*pathTracer, setup, settings, *field, scene); !done) return done.error();
    std::vector<MethodResult*> methods{&scene.none, &scene.leaky, &scene.ddgi};
    if (scene.realtime) methods.push_back(&scene.realtime->method);
    for (MethodResult* method : methods)
        if (auto done = judge(*method, scene.reference, {setup.exposure, false}); !done) return done.error();
    return scene;
}

}  // namespace probegi::tool
