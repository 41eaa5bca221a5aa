#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <new>
#include <optional>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/sentence.h"
#include "geometry/lighting.h"
#include "reference/film.h"
#include "reference/guide_learning.h"
#include "reference/irradiance_estimate.h"
#include "reference/path_batch.h"
#include "reference/pinhole_camera.h"

namespace probegi {

struct PathTracer::Impl {
    Context context;
    Transport transport;
};

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kPathsPerBatch = 1024;
/// Maximum samples per pixel between checks of the stopping rules.
constexpr int kMaxSamplesPerPass = 16;
/// Number of camera rays that determine where to learn a guide, and a salt that separates their random numbers from the
/// picture's.
constexpr std::size_t kGuideRays = 16384;
constexpr std::uint64_t kGuideSeed = 0x67756964696e67ull;
/// With fewer samples, the error estimate is too unreliable to stop by.
constexpr int kMinSamplesForError = 16;

/// When to stop, and the progress towards it.
class StoppingRules {
public:
    explicit StoppingRules(const ReferenceDesc& desc) : m_desc(desc), m_start(Clock::now()) {}

    double seconds() const { return std::chrono::duration<double>(Clock::now() - m_start).count(); }

    bool done(int samples, const Film& film) {
        if (m_desc.samplesPerPixel > 0 && samples >= m_desc.samplesPerPixel) return true;
        if (m_desc.seconds > 0 && seconds() >= m_desc.seconds) return true;
        if (m_desc.relativeError <= 0 || samples < kMinSamplesForError) return false;
        const double error = film.relativeError();
        // The error falls with the square root of the work.
        m_errorShare = error > 0 ? std::pow(m_desc.relativeError / error, 2) : 1;
        return error <= m_desc.relativeError;
    }

    /// Passes grow while they are cheap; near a time limit they shrink so as not to overrun it.
    int nextPass(int samples) const {
        int pass = std::clamp(samples, 1, kMaxSamplesPerPass);
        if (m_desc.samplesPerPixel > 0) pass = std::min(pass, m_desc.samplesPerPixel - samples);
        if (m_desc.seconds > 0 && samples > 0) {
            const double perSample = seconds() / samples;
            pass = std::clamp(int((m_desc.seconds - seconds()) / std::max(perSample, 1e-9)), 1, pass);
        }
        return pass;
    }

    /// Progress towards the nearest limit. `samples` may be fractional, during a pass.
    double fraction(double samples) const {
        double share = m_errorShare;
        if (m_desc.samplesPerPixel > 0) share = std::max(share, samples / m_desc.samplesPerPixel);
        if (m_desc.seconds > 0) share = std::max(share, seconds() / m_desc.seconds);
        return share;
    }

private:
    ReferenceDesc m_desc;
    Clock::time_point m_start;
    double m_errorShare = 0;
};

/// `count` more samples, from number `first` on, for the pixels begin..end.
Result<void> tracePixels(const Transport& transport, const ReferenceDesc& desc, const PathSettings& settings,
                         const PinholeCamera& camera, std::size_t begin, std::size_t end, int first, int count,
                         Film& film) {
    std::vector<Ray> rays;
    std::vector<Random> random;
    for (std::size_t pixel = begin; pixel < end; ++pixel)
        for (int s = first; s < first + count; ++s) {
            Random stream(desc.seed, std::uint64_t(s) << 32 | pixel);
            rays.push_back(camera.ray(pixel, stream.nextPair()));
            random.push_back(stream);
        }
    std::vector<PathResult> results(rays.size());
    if (auto traced = PathBatch(transport, settings).fromCamera(rays, random, results); !traced) return traced;
    for (std::size_t i = 0; i < results.size(); ++i) film.add(begin + i / std::size_t(count), results[i]);
    return {};
}

/// Learns from what the camera sees, on separate rays through random pixels.
Result<PathGuide> learnFromCamera(const Context& context, const Transport& transport, const ReferenceDesc& desc,
                                  const PinholeCamera& camera) {
    const std::size_t pixels = std::size_t(desc.picture.width) * std::size_t(desc.picture.height);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < kGuideRays; ++i) {
        Random random(desc.seed ^ kGuideSeed, i);
        const auto pixel = std::size_t((double(i) + random.nextDouble()) / double(kGuideRays) * double(pixels));
        rays.push_back(camera.ray(std::min(pixel, pixels - 1), random.nextPair()));
    }
    return receiversSeen(transport, rays).and_then([&](std::vector<GuideReceiver> seen) {
        return learnGuide(context, transport, *desc.guide, std::move(seen), desc.seed ^ kGuideSeed);
    });
}

/// Learns from the points, each repeated to get as many starting points as for a picture.
Result<PathGuide> learnFromPoints(const Context& context, const Transport& transport,
                                  std::span<const FieldQuery> points, const Field& field, std::uint64_t seed) {
    std::vector<GuideReceiver> first;
    for (std::size_t i = 0; i < kGuideRays && !points.empty(); ++i) {
        const FieldQuery& point = points[i % points.size()];
        first.push_back({point.position, point.normal, point.normal, 0});
    }
    return learnGuide(context, transport, field, std::move(first), seed ^ kGuideSeed);
}

Result<void> checkDesc(const ReferenceDesc& desc) {
    const auto bad = [](const std::string& sentence) { return fail(ErrorCode::invalidArgument, sentence); };
    const PictureDesc& picture = desc.picture;
    if (picture.width < 1 || picture.width > 16384 || picture.height < 1 || picture.height > 16384)
        return bad(sentence("The picture size is ", picture.width, "x", picture.height,
                            "; each side must be 1 to 16384 pixels."));
    if (!(picture.camera.yfov > 0 && picture.camera.yfov < kernels::kPi))
        return bad(sentence("The camera's yfov is ", picture.camera.yfov, "; it must lie between 0 and pi."));
    if (desc.samplesPerPixel < 0 || !(desc.seconds >= 0) || !(desc.relativeError >= 0) || desc.maxBounces < 0)
        return bad("samplesPerPixel, seconds, relativeError and maxBounces of the reference must not be negative.");
    if (desc.samplesPerPixel == 0 && desc.seconds == 0 && desc.relativeError == 0)
        return bad("The reference has no stopping rule; set samplesPerPixel, seconds or relativeError.");
    return {};
}

Result<ReferencePicture> renderPasses(const Context& context, const Transport& transport, const ReferenceDesc& desc) {
    const PinholeCamera camera(desc.picture);
    Film film(desc.picture.width, desc.picture.height);
    StoppingRules rules(desc);
    std::optional<PathGuide> guide;
    if (desc.guide) {
        auto learned = learnFromCamera(context, transport, desc, camera);
        if (!learned) return learned.error();
        guide = std::move(*learned);
    }
    const double guideSeconds = desc.guide ? rules.seconds() : 0;
    const PathSettings settings{.diffuseOnly = desc.picture.diffuseOnly,
                                .maxBounces = desc.maxBounces,
                                .guide = guide && !guide->empty() ? &*guide : nullptr};
    Progress progress(context, "path tracing", 1);
    int samples = 0;
    while (!rules.done(samples, film)) {
        const int pass = rules.nextPass(samples);
        std::atomic<std::size_t> pixelsDone = 0;
        const auto trace = [&](std::size_t begin, std::size_t end) -> Result<void> {
            if (progress.cancelled()) return {};
            auto traced = tracePixels(transport, desc, settings, camera, begin, end, samples, pass, film);
            const auto done = double(pixelsDone += end - begin);
            progress.set(rules.fraction(samples + pass * done / double(film.pixelCount())));
            return traced;
        };
        const std::size_t grain = std::max<std::size_t>(1, kPathsPerBatch / std::size_t(pass));
        if (auto traced = tryParallelFor(context, film.pixelCount(), grain, trace); !traced) return traced.error();
        if (progress.cancelled()) return fail(ErrorCode::cancelled, "Path tracing was cancelled.");
        samples += pass;
    }
    if (const std::int64_t rejected = film.rejectedCount(); rejected > 0)
        context.log(LogLevel::warning, sentence(rejected, " paths were not finite and count as black."));
    ReferencePicture out = film.develop();
    out.samplesPerPixel = samples;
    out.seconds = rules.seconds();
    out.guideSeconds = guideSeconds;
    return out;
}

}  // namespace

Result<PathTracer> PathTracer::create(const Context& context, const Scene& scene, const ScenePose& pose,
                                      const Tracer& tracer, const Lighting& lighting) try {
    Transport transport{&tracer, lighting.lights, EmitterSampler(scene, pose), SkyLight(lighting.sky),
                        sceneMagnitude(tracer.bounds())};
    return PathTracer(std::make_unique<Impl>(Impl{context, std::move(transport)}));
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "There is not enough memory for the light tables of the reference.");
}

PathTracer::PathTracer(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
PathTracer::PathTracer(PathTracer&&) noexcept = default;
PathTracer& PathTracer::operator=(PathTracer&&) noexcept = default;
PathTracer::~PathTracer() = default;

Result<ReferencePicture> PathTracer::render(const ReferenceDesc& desc) const try {
    if (const Result<void> checked = checkDesc(desc); !checked) return checked.error();
    return renderPasses(m_impl->context, m_impl->transport, desc);
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, sentence("There is not enough memory for a reference of ", desc.picture.width,
                                                 "x", desc.picture.height, " pixels; make it smaller."));
}

Result<std::vector<ReferenceIrradiance>> PathTracer::irradiance(std::span<const FieldQuery> points, int samples,
                                                                std::uint64_t seed, bool diffuseOnly,
                                                                const Field* guide) const try {
    if (samples < 1)
        return fail(ErrorCode::invalidArgument,
                    sentence("samples is ", samples, "; the reference irradiance needs at least 1."));
    std::optional<PathGuide> learned;
    if (guide) {
        auto lessons = learnFromPoints(m_impl->context, m_impl->transport, points, *guide, seed);
        if (!lessons) return lessons.error();
        learned = std::move(*lessons);
    }
    const PathSettings settings{.diffuseOnly = diffuseOnly,
                                .guide = learned && !learned->empty() ? &*learned : nullptr};
    return estimateIrradiance(m_impl->context, m_impl->transport, settings, points, samples, seed);
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "There is not enough memory for the reference irradiance; split the request.");
}

}  // namespace probegi
