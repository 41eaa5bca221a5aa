#include "probegi/field.h"

#include <cmath>
#include <new>

#include "core/progress.h"
#include "core/sentence.h"
#include "field/convergence.h"
#include "field/field_backend.h"

namespace probegi {

namespace {

constexpr const char* kNoRayDataMemory = "no memory for the update's ray data; use fewer probes or rays";
}  // namespace

struct Field::Impl {
    Impl(const Context& c, const FieldDesc& desc, std::unique_ptr<FieldBackend> b)
        : context(c), books(desc), backend(std::move(b)) {}

    // A failed update is no frame: the next one has its rays and its dither.
    Result<UpdateTimes> ended(Result<UpdateTimes> times) {
        if (times) books.advance();
        return times;
    }

    // What the convergence wants to know of the probes after an update.
    Result<void> observe(Convergence& convergence) {
        if (!convergence.observes()) {
            convergence.advance({}, {});
            return {};
        }
        const auto brightness = backend->brightness();
        if (!brightness) return brightness.error();
        std::vector<float> backfaceShares(brightness->size());
        for (std::size_t probe = 0; probe < backfaceShares.size(); ++probe)
            backfaceShares[probe] = backend->probeBackfaceShare(int(probe));
        convergence.advance(*brightness, backfaceShares);
        return {};
    }

    static Field make(std::unique_ptr<Impl> impl) { return Field(std::move(impl)); }
    static const FieldBackend& backendOf(const Field& field) { return *field.m_impl->backend; }

    Context context;
    FrameBooks books;
    std::unique_ptr<FieldBackend> backend;
};

Field makeFieldOn(const Context& context, const FieldDesc& desc, std::unique_ptr<FieldBackend> backend) {
    return Field::Impl::make(std::make_unique<Field::Impl>(context, desc, std::move(backend)));
}

const FieldBackend& backendOf(const Field& field) noexcept {
    return Field::Impl::backendOf(field);
}

Error probesDoNotFit(const FieldDesc& desc) {
    return {ErrorCode::outOfMemory,
            sentence("no memory for ", probeCount(desc.grid), " probes; use fewer or smaller ones")};
}

Field::Field(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
Field::Field(Field&&) noexcept = default;
Field& Field::operator=(Field&&) noexcept = default;
Field::~Field() = default;

const FieldDesc& Field::desc() const noexcept {
    return m_impl->books.desc();
}
int Field::frame() const noexcept {
    return m_impl->books.frame();
}
std::span<const glm::vec3> Field::rayDirections() const noexcept {
    return m_impl->books.rayDirections();
}
std::span<const glm::vec3> Field::fixedRayDirections() const noexcept {
    return m_impl->books.fixedRayDirections();
}
std::uint64_t Field::fallbackQueries() const noexcept {
    return m_impl->backend->fallbackQueries();
}
void Field::notify(FieldEvent event) noexcept {
    m_impl->books.notify(event);
}
void Field::setGuard(LeakGuard guard) noexcept {
    m_impl->books.setGuard(guard);
}

FieldMemory Field::memory() const noexcept {
    FieldMemory memory = m_impl->backend->memory();
    memory.stateBytes += m_impl->books.bytes();
    return memory;
}

Result<UpdateTimes> Field::update(std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays) try {
    const FieldDesc& desc = m_impl->books.desc();
    const std::size_t probes = std::size_t(probeCount(desc.grid));
    const std::size_t expected = probes * std::size_t(desc.raysPerProbe);
    if (rayData.size() != expected)
        return fail(ErrorCode::invalidArgument, sentence("rayData has ", rayData.size(),
                                                         " entries; it must have probes x raysPerProbe = ", expected));
    const std::size_t expectedFixed = probes * m_impl->books.fixedRayDirections().size();
    if (!fixedRays.empty() && fixedRays.size() != expectedFixed)
        return fail(
            ErrorCode::invalidArgument,
            sentence("fixedRays has ", fixedRays.size(),
                     " entries; it must be empty or have an entry for each probe and each of fixedRayDirections(), ",
                     expectedFixed));
    const UpdateFrame frame =
        fixedRays.empty() ? m_impl->books.comingUpdateWithoutFixedRays() : m_impl->books.comingUpdate();
    return m_impl->ended(m_impl->backend->update(frame, rayData, fixedRays));
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

Result<UpdateTimes> Field::update(const Tracer& tracer, const Lighting& lighting) try {
    return m_impl->ended(m_impl->backend->update(m_impl->books.comingUpdate(), tracer, lighting));
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

Result<ConvergeResult> Field::converge(const Tracer& tracer, const Lighting& lighting, float tolerance, int maxFrames,
                                       const std::function<void(const UpdateTimes&)>& onUpdate) try {
    if (!(tolerance > 0)) return fail(ErrorCode::invalidArgument, "tolerance must be greater than 0");
    if (maxFrames < 1) return fail(ErrorCode::invalidArgument, "maxFrames must be at least 1");
    Impl& m = *m_impl;
    Progress progress(m.context, "converging probes", maxFrames);
    Convergence convergence(m.books.desc(), tolerance, maxFrames);
    const struct Averaging {
        FrameBooks& books;
        explicit Averaging(FrameBooks& b) : books(b) { books.setAveraging(true); }
        ~Averaging() { books.setAveraging(false); }
    } averaging(m.books);
    while (convergence.updates() < maxFrames && !convergence.converged()) {
        const auto times = m.backend->update(m.books.comingAverage(convergence.kept()), tracer, lighting);
        if (!times) return times.error();
        const auto observed = m.observe(convergence);
        m.books.advance(convergence.turnsRays());
        if (!observed) return observed.error();
        if (onUpdate) onUpdate(*times);
        if (!progress.advance()) return fail(ErrorCode::cancelled, "cancelled while converging probes");
    }
    return ConvergeResult{convergence.updates(), convergence.converged(), convergence.remaining()};
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

glm::vec3 Field::irradiance(const FieldQuery& query) const noexcept {
    return m_impl->backend->irradiance(m_impl->books.desc(), query);
}

Result<void> Field::irradiance(std::span<const FieldQuery> queries, std::span<glm::vec3> out) const try {
    if (queries.size() != out.size())
        return fail(ErrorCode::invalidArgument, sentence("there are ", queries.size(), " queries and room for ",
                                                         out.size(), " answers; both spans must be equally long"));
    return m_impl->backend->irradiance(m_impl->books.desc(), queries, out);
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory for this many queries; ask for fewer at a time");
}

float Field::probeBackfaceShare(int probe) const noexcept {
    return m_impl->backend->probeBackfaceShare(probe);
}

glm::vec3 Field::probeIrradiance(int probe, glm::vec3 normal) const noexcept {
    return m_impl->backend->probeIrradiance(probe, normal);
}

glm::vec2 Field::probeDistanceMoments(int probe, glm::vec3 direction) const noexcept {
    return m_impl->backend->probeDistanceMoments(probe, direction);
}

}  // namespace probegi
