#include "report/render.h"

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <tuple>
#include <utility>

#include "audit/picture.h"
#include "render_stats.h"

namespace probegi::tool {

namespace {

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count(); }

private:
    std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

constexpr int kOthersShrink = 2;  // the pictures of all cameras but the first

PictureDesc pictureDesc(const RenderedView& view, const ReportSettings& settings) {
    PictureDesc desc;
    desc.camera = view.camera;
    desc.width = std::max(1, settings.width / view.shrink);
    desc.height = std::max(1, settings.height / view.shrink);
    desc.diffuseOnly = settings.diffuseOnly;
    return desc;
}

/// What all pieces of the work share.
struct Studio {
    const Backend& backend;
    const Tracer& tracer;       ///< the backend's
    PictureRenderer& renderer;  ///< the backend's
    const LoadedSetup& setup;
    const ReportSettings& settings;

    void begin(const char* piece) const {
        if (settings.onPiece) settings.onPiece(piece);
    }
};

constexpr const char* kSetUp = "setting up";
constexpr const char* kProbeTruth = "path tracing probes";
constexpr const char* kWithout = "pictures without GI";
constexpr const char* kLeakyField = "leaking field";
constexpr const char* kField = "field";
constexpr const char* kRealtime = "field in real time";
constexpr const char* kReference = "path tracing";
constexpr const char* kComparing = "comparing pictures";
constexpr const char* kAudit = "looking for leaks";
constexpr int kAuditSamples = 128;  // paths a point by which places are confirmed

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

Result<MethodResult> drawMethod(const Studio& studio, const RenderedView& view, const Field* field) {
    auto rendered =
        studio.renderer.render(studio.tracer, studio.setup.lighting, field, pictureDesc(view, studio.settings));
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

/// The view of each camera, in the cameras' order.
std::vector<RenderedView*> viewsOf(RenderedScene& scene) {
    std::vector<RenderedView*> views{&scene};
    for (RenderedView& view : scene.others) views.push_back(&view);
    return views;
}

Result<void> drawViews(const Studio& studio, RenderedScene& scene, MethodResult RenderedView::*method,
                       const Field* field) {
    for (RenderedView* view : viewsOf(scene)) {
        auto drawn = drawMethod(studio, *view, field);
        if (!drawn) return drawn.error();
        view->*method = std::move(*drawn);
    }
    return {};
}

Result<FieldResult> fillAndMeasure(const Studio& studio, const ProbeTruth& truth, Field& field,
                                   const FieldRunOptions& run) {
    auto filled = fillField(field, studio.tracer, studio.setup.lighting, run);
    if (!filled) return filled;
    const auto probes = field.read();
    if (!probes) return probes.error();
    filled->ratio = percentiles(probeRatios(*probes, truth));
    return filled;
}

FieldDesc fieldDesc(const Studio& studio) {
    FieldDesc desc;
    desc.volumes = studio.setup.volumes;
    desc.raysPerProbe = studio.settings.raysPerProbe;
    desc.seed = studio.settings.seed;
    return desc;
}

Result<std::vector<ProbeSight>> lookAtProbes(const Field& field) {
    constexpr glm::vec3 kAxes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const VolumeDesc& grid = field.desc().volumes[0];
    const auto count = std::size_t(probeCount(grid));
    std::vector<FieldQuery> queries;
    for (std::size_t probe = 0; probe < count; ++probe)
        for (const glm::vec3& axis : kAxes) queries.push_back({probePosition(grid, int(probe)), axis, axis});
    std::vector<glm::vec3> answers(queries.size());
    if (const auto asked = field.irradiance(queries, answers); !asked) return asked.error();
    const auto stored = field.read({0, int(count)});
    if (!stored) return stored.error();
    std::vector<ProbeSight> probes(count);
    for (std::size_t i = 0; i < answers.size(); ++i)
        probes[i / std::size(kAxes)].irradiance +=
            glm::dot(answers[i], glm::vec3(0.2126f, 0.7152f, 0.0722f)) / float(std::size(kAxes));
    for (std::size_t probe = 0; probe < count; ++probe)
        probes[probe].backfaceShare = stored->state(int(probe)).backfaceShare;
    return probes;
}

/// Fills a new field by real-time updates and draws the first camera's picture with it.
Result<FieldPicture> drawRealtime(const Studio& studio, const RenderedScene& scene) {
    studio.begin(kRealtime);
    auto fresh = studio.backend.makeField(fieldDesc(studio), studio.setup.settings);
    if (!fresh) return fresh.error();
    auto filled = fillAndMeasure(studio, scene.truth, *fresh,
                                 {studio.settings.realtimeUpdates, {}, studio.settings.run.progress});
    if (!filled) return filled.error();
    auto drawn = drawMethod(studio, scene, &*fresh);
    if (!drawn) return drawn.error();
    return FieldPicture{std::move(*filled), std::move(*drawn)};
}

/// Fills and draws the field without and then with its leak guard. The second run starts from the light of the first,
/// which does not affect the converged result. Returns the field, which guides the path tracer.
Result<Field> drawFields(const Studio& studio, RenderedScene& scene) {
    auto field = studio.backend.makeField(fieldDesc(studio), studio.setup.settings);
    if (!field) return field.error();
    for (const auto& [guard, piece, result, method] :
         {std::tuple(LeakGuard::none, kLeakyField, &scene.leakyField, &RenderedView::leaky),
          std::tuple(LeakGuard::moments, kField, &scene.ddgiField, &RenderedView::ddgi)}) {
        studio.begin(piece);
        FieldSettings settings = field->control().settings();
        settings.guard = guard;
        if (auto set = field->control().setSettings(settings); !set) return set.error();
        auto filled = fillAndMeasure(studio, scene.truth, *field, studio.settings.run);
        if (!filled) return filled.error();
        *result = std::move(*filled);
        if (auto drawn = drawViews(studio, scene, method, &*field); !drawn) return drawn.error();
    }
    auto probes = lookAtProbes(*field);
    if (!probes) return probes.error();
    scene.probes = std::move(*probes);
    if (!studio.settings.realtimeUpdates) return std::move(*field);
    auto realtime = drawRealtime(studio, scene);
    if (!realtime) return realtime.error();
    scene.realtime = std::move(*realtime);
    return std::move(*field);
}

Result<void> scoreNoise(RenderedView& view, std::uint64_t seed) {
    auto whole = noiseFloor(view.reference.color, view.referenceError, seed, {view.exposure});
    if (!whole) return whole.error();
    view.noiseFloor = whole->difference;
    view.noiseMap = std::move(whole->flipMap);
    HdrImage indirectError = view.referenceError;
    for (std::size_t i = 0; i < indirectError.pixels.size(); ++i)
        indirectError.pixels[i] = glm::min(indirectError.pixels[i], view.reference.indirect.pixels[i]);
    const auto indirect = noiseFloor(view.reference.indirect, indirectError, seed, {view.exposure});
    if (!indirect) return indirect.error();
    view.indirectNoiseFloor = indirect->difference;
    return {};
}

Result<void> drawReference(const PathTracer& pathTracer, const Studio& studio, const Field& guide, RenderedView& view) {
    const ReportSettings& settings = studio.settings;
    studio.begin(kReference);
    ReferenceDesc desc;
    desc.guide = &guide;
    desc.picture = pictureDesc(view, settings);
    desc.seconds = settings.seconds / (view.shrink * view.shrink);
    desc.samplesPerPixel = settings.samplesPerPixel;
    desc.seed = settings.seed;
    auto reference = pathTracer.render(desc);
    if (!reference) return reference.error();
    view.referenceSamples = reference->samplesPerPixel;
    view.referenceSeconds = reference->seconds;
    const auto noise = relativeNoise(reference->picture.color, reference->standardError);
    if (!noise) return noise.error();
    view.referenceNoise = *noise;
    view.reference = std::move(reference->picture);
    view.referenceError = std::move(reference->standardError);
    view.exposure = shownExposure(studio.setup, view.reference.color);
    return {};
}

/// A sealed room has no light to choose an exposure by. Limits exposures to a multiple of the first camera's.
void limitExposures(RenderedScene& scene) {
    constexpr float kBrightest = 30;
    for (RenderedView& view : scene.others) {
        const auto lit = [](const glm::vec3& p) { return p.x > 0 || p.y > 0 || p.z > 0; };
        const auto& pixels = view.reference.color.pixels;
        const bool black = std::none_of(pixels.begin(), pixels.end(), lit);
        view.exposure = black ? scene.exposure : std::min(view.exposure, kBrightest * scene.exposure);
    }
}

Result<void> compareViews(const Studio& studio, RenderedScene& scene) {
    studio.begin(kComparing);
    limitExposures(scene);
    for (RenderedView* view : viewsOf(scene)) {
        if (auto done = scoreNoise(*view, studio.settings.seed); !done) return done;
        std::vector<MethodResult*> methods{&view->none, &view->leaky, &view->ddgi};
        if (view == &scene && scene.realtime) methods.push_back(&scene.realtime->method);
        for (MethodResult* method : methods)
            if (auto done = judge(*method, view->reference, {view->exposure, false}); !done) return done;
        auto leaks = findLeaks({view->ddgi.picture.color, view->ddgi.picture.indirect, view->reference.indirect,
                                view->referenceError, view->exposure});
        if (!leaks) return leaks.error();
        view->leaks = std::move(*leaks);
    }
    return {};
}

/// Looks for leaks all over the scene, and in what each camera sees.
Result<void> auditField(const Context& context, const Studio& studio, const Tracer& rays, const PathTracer& pathTracer,
                        const Field& field, RenderedScene& scene) {
    studio.begin(kAudit);
    AuditDesc desc;
    desc.seed = studio.settings.seed;
    desc.truthSamples = kAuditSamples;
    desc.truth = &pathTracer;
    auto audit = auditLeaks(context, *studio.setup.scene, studio.setup.pose, rays, field, desc);
    if (!audit) return audit.error();
    scene.audit = std::move(*audit);
    desc.truth = nullptr;
    scene.auditDesc = desc;
    scene.origin = studio.setup.scene->origin;
    for (RenderedView* view : viewsOf(scene)) {
        const HdrImage& color = view->ddgi.picture.color;
        const auto seen = leaksSeen(context, rays, field, view->camera, color.width, color.height);
        if (!seen) return seen.error();
        view->hiddenLeaks = drawLeaks(color, view->exposure, *seen, desc);
    }
    return {};
}

}  // namespace

std::vector<PlacedCamera> reportCameras(const LoadedSetup& setup, const ReportSettings& settings) {
    std::vector<PlacedCamera> cameras{setup.camera};
    if (!settings.allCameras) return cameras;
    for (const PlacedCamera& camera : setup.pose.cameras)
        if (camera.position != setup.camera.position || camera.forward != setup.camera.forward)
            cameras.push_back(camera);
    return cameras;
}

std::vector<ReportPiece> reportPieces(const LoadedSetup& setup, const ReportSettings& settings) {
    const std::size_t cameras = reportCameras(setup, settings).size();
    const double others = double(cameras - 1) / (kOthersShrink * kOthersShrink);
    const double pixels = double(settings.width) * settings.height * (1 + others);
    const double probes = probeCount(setup);
    const double picture = 1e-6 * pixels, update = 2e-7 * probes * settings.raysPerProbe;
    const double updates = settings.run.frames.value_or(40);
    const double reference =
        settings.seconds > 0 ? settings.seconds : 2e-6 * settings.width * settings.height * settings.samplesPerPixel;
    std::vector<ReportPiece> pieces{{kSetUp, 1e-6 * double(triangleCount(*setup.scene, setup.pose))},
                                    {kProbeTruth, 2e-5 * settings.ratioProbes * settings.ratioSamples},
                                    {kWithout, picture},
                                    {kLeakyField, updates * update + picture},
                                    {kField, updates * update + picture}};
    if (settings.realtimeUpdates) pieces.push_back({kRealtime, *settings.realtimeUpdates * update + picture});
    for (std::size_t camera = 0; camera < cameras; ++camera)
        pieces.push_back({kReference, camera == 0 ? reference : reference / (kOthersShrink * kOthersShrink)});
    pieces.push_back({kComparing, 4e-6 * pixels});
    pieces.push_back({kAudit, 2 + 5e-6 * pixels});
    return pieces;
}

Result<RenderedScene> renderForReport(const Context& context, const Backend& backend, const LoadedSetup& setup,
                                      const ReportSettings& settings) {
    RenderedScene scene;
    const std::vector<PlacedCamera> cameras = reportCameras(setup, settings);
    scene.others.resize(cameras.size() - 1);
    for (std::size_t i = 0; i < cameras.size(); ++i) viewsOf(scene)[i]->camera = cameras[i];
    for (RenderedView& view : scene.others) view.shrink = kOthersShrink;
    scene.triangles = triangleCount(*setup.scene, setup.pose);
    scene.lights = setup.lighting.lights.size();
    scene.grid = setup.grid;
    if (settings.onPiece) settings.onPiece(kSetUp);
    const Stopwatch watch;
    const auto tracer = makeEmbreeTracer(context, *setup.scene, setup.pose);
    if (!tracer) return tracer.error();
    const auto pathTracer = PathTracer::create(context, *setup.scene, setup.pose, **tracer, setup.lighting);
    if (!pathTracer) return pathTracer.error();
    scene.prepareSeconds = watch.seconds();
    std::unique_ptr<Tracer> another;  // if the backend cannot use the reference's tracer
    if (backend.kind() != BackendKind::cpu) {
        auto made = backend.openScene(*setup.scene, setup.pose);
        if (!made) return made.error();
        another = std::move(*made);
    }
    const auto renderer = backend.makeRenderer();
    if (!renderer) return renderer.error();
    const Studio studio{backend, another ? *another : **tracer, **renderer, setup, settings};

    studio.begin(kProbeTruth);
    auto truth = traceProbeTruth(**tracer, *pathTracer, setup.grid, settings.ratioProbes, settings.ratioSamples,
                                 settings.diffuseOnly);
    if (!truth) return truth.error();
    scene.truth = std::move(*truth);
    studio.begin(kWithout);
    if (auto drawn = drawViews(studio, scene, &RenderedView::none, nullptr); !drawn) return drawn.error();
    const auto field = drawFields(studio, scene);
    if (!field) return field.error();
    for (RenderedView* view : viewsOf(scene))
        if (auto done = drawReference(*pathTracer, studio, *field, *view); !done) return done.error();
    if (auto done = compareViews(studio, scene); !done) return done.error();
    if (auto done = auditField(context, studio, **tracer, *pathTracer, *field, scene); !done) return done.error();
    return scene;
}

}  // namespace probegi::tool
