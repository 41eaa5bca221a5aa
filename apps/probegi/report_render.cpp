#include "report_render.h"

#include <chrono>
#include <glm/common.hpp>
#include <random>

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

/// The reference with as much noise again as its standard error says that it has.
HdrImage noisyTwin(const ReferencePicture& reference, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<float> normal;
    HdrImage twin = reference.picture.color;
    for (std::size_t i = 0; i < twin.pixels.size(); ++i)
        twin.pixels[i] = glm::max(twin.pixels[i] + reference.standardError.pixels[i] * normal(random), 0.0f);
    return twin;
}

Result<FieldResult> runField(Field& field, const Tracer& tracer, const Lighting& lighting,
                             const ReportSettings& settings) {
    FieldResult result;
    std::vector<UpdateTimes> times;
    const Stopwatch watch;
    if (settings.frames) {
        for (int frame = 0; frame < *settings.frames; ++frame) {
            const auto update = field.update(tracer, lighting);
            if (!update) return tl::unexpected(update.error());
            times.push_back(*update);
        }
        result.updates = *settings.frames;
    } else {
        const auto record = [&](const UpdateTimes& update) { times.push_back(update); };
        const auto updates = field.converge(tracer, lighting, kConvergeTolerance, kConvergeMaxUpdates, record);
        if (!updates) return tl::unexpected(updates.error());
        result.updates = *updates;
    }
    result.seconds = watch.seconds();
    result.update = medianTimes(times);
    result.memory = field.memory();
    return result;
}

Result<MethodResult> drawMethod(const Backend& backend, const Tracer& tracer, const LoadedSetup& setup,
                                const ReportSettings& settings, const Field* field) {
    auto rendered = backend.render(tracer, setup.lighting, field, pictureDesc(setup, settings));
    if (!rendered) return tl::unexpected(rendered.error());
    MethodResult result;
    result.picture = std::move(rendered->picture);
    result.pictureMs = rendered->times.total;
    return result;
}

Result<void> judge(MethodResult& method, const Picture& reference, const ToneMap& toneMap) {
    auto whole = compareImages(method.picture.color, reference.color, toneMap);
    if (!whole) return tl::unexpected(whole.error());
    const auto indirect = compareImages(method.picture.indirect, reference.indirect, toneMap);
    if (!indirect) return tl::unexpected(indirect.error());
    method.whole = std::move(*whole);
    method.indirectOnly = indirect->difference;
    return {};
}

/// The field with and without its leak guard. The second run starts from the first one's light, which it forgets. The
/// field comes back for whoever wants to be guided by it.
Result<Field> drawFields(const Backend& backend, const Tracer& tracer, const LoadedSetup& setup,
                         const ReportSettings& settings, RenderedScene& scene) {
    FieldDesc desc;
    desc.grid = setup.grid;
    desc.raysPerProbe = settings.raysPerProbe;
    desc.seed = settings.seed;
    auto field = backend.makeField(desc);
    if (!field) return tl::unexpected(field.error());
    const auto run = [&](LeakGuard guard, FieldResult& result, MethodResult& method) -> Result<void> {
        field->setGuard(guard);
        auto done = runField(*field, tracer, setup.lighting, settings);
        if (!done) return tl::unexpected(done.error());
        result = *done;
        result.ratio = percentiles(probeRatios(*field, scene.truth));
        auto drawn = drawMethod(backend, tracer, setup, settings, &*field);
        if (!drawn) return tl::unexpected(drawn.error());
        method = std::move(*drawn);
        return {};
    };
    if (auto done = run(LeakGuard::moments, scene.ddgiField, scene.ddgi); !done) return tl::unexpected(done.error());
    if (auto done = run(LeakGuard::none, scene.leakyField, scene.leaky); !done) return tl::unexpected(done.error());
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
    if (!reference) return tl::unexpected(reference.error());
    scene.referenceSamples = reference->samplesPerPixel;
    scene.referenceSeconds = reference->seconds;
    scene.referenceNoise = relativeNoise(*reference);
    const auto floor = compareImages(noisyTwin(*reference, settings.seed), reference->picture.color, {setup.exposure});
    if (!floor) return tl::unexpected(floor.error());
    scene.noiseFloor = floor->difference;
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
    if (!tracer) return tl::unexpected(tracer.error());
    const auto pathTracer = PathTracer::create(context, *setup.scene, setup.pose, **tracer, setup.lighting);
    if (!pathTracer) return tl::unexpected(pathTracer.error());
    scene.prepareSeconds = watch.seconds();
    std::unique_ptr<Tracer> another;  // where the reference's is not the backend's
    if (backend.kind() != BackendKind::cpu) {
        auto made = backend.makeTracer(*setup.scene, setup.pose);
        if (!made) return tl::unexpected(made.error());
        another = std::move(*made);
    }
    const Tracer& drawing = another ? *another : **tracer;

    auto truth = traceProbeTruth(**tracer, *pathTracer, setup.grid, settings.ratioProbes, settings.ratioSamples,
                                 settings.diffuseOnly);
    if (!truth) return tl::unexpected(truth.error());
    scene.truth = std::move(*truth);
    auto none = drawMethod(backend, drawing, setup, settings, nullptr);
    if (!none) return tl::unexpected(none.error());
    scene.none = std::move(*none);
    const auto field = drawFields(backend, drawing, setup, settings, scene);
    if (!field) return tl::unexpected(field.error());
    if (auto done = drawReference(*pathTracer, setup, settings, *field, scene); !done)
        return tl::unexpected(done.error());
    for (MethodResult* method : {&scene.none, &scene.leaky, &scene.ddgi})
        if (auto done = judge(*method, scene.reference, {setup.exposure, false}); !done)
            return tl::unexpected(done.error());
    return scene;
}

}  // namespace probegi::tool
