#include "probegi/field.h"

#include <cmath>
#include <new>
#include <optional>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/sentence.h"
#include "field/control_impl.h"
#include "field/convergence.h"
#include "field/field_backend.h"
#include "field/probe_placement.h"
#include "field/snapshot.h"
#include "kernels/probe/packed_ray.h"

namespace probegi {

namespace {

constexpr const char* kNoScrollMemory = "no memory to scroll a volume";
constexpr const char* kNoRayDataMemory = "no memory for the update's ray data; use fewer probes or rays";

// All active probes take part in an average, whatever the tasks of updates are.
class Averaging {
public:
    explicit Averaging(FieldControl::Impl& books)
        : m_books(books), m_tasks(tasksOf(books.volumes, books.states, {})), m_list(books.taskList) {
        std::swap(m_books.tasks, m_tasks);
        m_books.taskList = books.states.allAreTasks() ? 0 : ++books.taskLists;
        m_books.setAveraging(true);
    }
    ~Averaging() {
        std::swap(m_books.tasks, m_tasks);
        m_books.taskList = m_list;
        m_books.setAveraging(false);
        m_books.chooseTasks();
    }
    Averaging(const Averaging&) = delete;
    Averaging& operator=(const Averaging&) = delete;

private:
    FieldControl::Impl& m_books;
    std::vector<ProbeTask> m_tasks;
    std::uint32_t m_list;
};

}  // namespace

struct Field::Impl {
    Impl(const Context& c, const FieldDesc& desc, const FieldSettings& settings, std::unique_ptr<FieldBackend> b)
        : context(c), control(makeFieldControl(desc, settings)), backend(std::move(b)) {}

    FieldControl::Impl& books() noexcept { return control.impl(); }

    // A failed update is no frame: the next one has its rays and its dither.
    Result<UpdateTimes> ended(bool asked, Result<UpdateTimes> times) {
        if (!times) return times;
        control.reportTime(times->total, int(control.tasks().size()));
        books().advance(true, asked ? backend->progress() : std::span<const kernels::ProbeProgress>());
        return times;
    }

    // Before an update: the backend learns where the probes stand and which of them forget what they know.
    Result<void> tellPlaces() {
        ProbeStates& states = books().states;
        if (!states.changed()) return {};
        auto told = backend->setPlacements(control.settings(), states.placements(), states.renewed());
        if (told) states.told();
        return told;
    }

    // Ends a look around of probes that are not placed yet.
    void place(const FoundPlaces& found) {
        FieldControl::Impl& b = books();
        b.states.placed(found.placements, found.surfaces);
        b.states.wake(b.volumes, b.settings, b.desc.rules);
        b.listTasks();
    }

    // Places new probes by rays of their own, so that none is left.
    Result<void> prepare(const Tracer& tracer) {
        FieldControl::Impl& b = books();
        if (b.states.hasNew()) {
            const auto found = placeProbes(context, b.comingUpdate(), b.states.placements(), b.states.moving(), tracer);
            if (!found) return found.error();
            place(*found);
        }
        return tellPlaces();
    }

    // What the convergence wants to know of the probes after an update.
    Result<void> observe(Convergence& convergence) {
        if (!convergence.observes()) {
            convergence.advance({}, {});
            return {};
        }
        const auto light = backend->light();
        if (!light) return light.error();
        convergence.advance(light->brightness, light->backfaceShares);
        return {};
    }

    struct ConvergeCall {
        float tolerance;
        int maxFrames;
        const std::function<void(const UpdateTimes&)>& onUpdate;
        ConvergeState* state;  // null: not asked for
    };

    // The convergence's words, then the number of the frame whose rays are still in use and whether settle() is done.
    void keep(const Convergence& convergence, ConvergeState* state, bool settled = false) {
        if (!state) return;
        convergence.save(state->words);
        state->words.push_back(std::uint32_t(books().rayFrame));
        state->words.push_back(settled ? 1 : 0);
    }
    // Returns whether settle() is done.
    Result<bool> goOn(const ConvergeState* state, Convergence& convergence) {
        if (!state || state->empty()) return false;
        const std::span<const std::uint32_t> words = state->words;
        const int rayFrame = words.size() < 2 ? -1 : int(words[words.size() - 2]);
        if (rayFrame < 0 || rayFrame > books().frame || !convergence.restore(words.first(words.size() - 2)))
            return fail(ErrorCode::invalidArgument,
                        "the state to converge from is not one of this field's; begin with an empty one");
        books().turnRaysAt(rayFrame);
        return words.back() != 0;
    }

    // An update that only looks, so that update() goes on from the average and does not begin a noisy one of its own.
    Result<void> settle(const Convergence& convergence, const Tracer& tracer, const Lighting& lighting) {
        const UpdateFrame frame = books().comingSettled();
        if (!frame.settles || !convergence.averages()) return {};
        auto times = ended(frame.reportsProgress, backend->update(frame, tracer, lighting));
        if (!times) return times.error();
        return {};
    }

    Result<ConvergeResult> converge(const Tracer& tracer, const Lighting& lighting, const ConvergeCall& call) {
        if (!(call.tolerance > 0)) return fail(ErrorCode::invalidArgument, "tolerance must be greater than 0");
        if (call.maxFrames < 1) return fail(ErrorCode::invalidArgument, "maxFrames must be at least 1");
        Progress progress(context, "converging probes", call.maxFrames);
        if (auto ready = prepare(tracer); !ready) return ready.error();
        Convergence convergence(books().desc, books().volumes, call.tolerance, call.maxFrames);
        const Averaging averaging(books());
        auto settled = goOn(call.state, convergence);
        if (!settled) return settled.error();
        bool goesOn = convergence.updates() == 0 || progress.advance(convergence.updates());
        while (goesOn && convergence.updates() < call.maxFrames && !convergence.converged()) {
            const auto times = backend->update(books().comingAverage(convergence.kept()), tracer, lighting);
            if (!times) return times.error();
            const auto observed = observe(convergence);
            books().advance(convergence.turnsRays());
            if (!observed) return observed.error();
            *settled = false;
            keep(convergence, call.state);
            if (call.onUpdate) call.onUpdate(*times);
            goesOn = progress.advance();
        }
        if (!goesOn) return fail(ErrorCode::cancelled, "cancelled while converging probes");
        if (!*settled) {
            if (auto done = settle(convergence, tracer, lighting); !done) return done.error();
            keep(convergence, call.state, true);
        }
        return ConvergeResult{convergence.updates(), convergence.converged(), convergence.remaining()};
    }

    void swapPlacement(FieldControl::Impl::Placement& other) noexcept {
        books().swapPlacement(other);
        backend->place(books().volumes);
    }
    Result<void> enter(int volume, glm::ivec3 cells) try {
        return backend->enter(control.settings(), volume, cells);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::outOfMemory, kNoScrollMemory);
    }

    static Field make(std::unique_ptr<Impl> impl) { return Field(std::move(impl)); }
    static const FieldBackend& backendOf(const Field& field) { return *field.m_impl->backend; }

    Context context;
    FieldControl control;
    std::unique_ptr<FieldBackend> backend;
};

Field makeFieldOn(const Context& context, const FieldDesc& desc, const FieldSettings& settings,
                  std::unique_ptr<FieldBackend> backend) {
    return Field::Impl::make(std::make_unique<Field::Impl>(context, desc, settings, std::move(backend)));
}

const FieldBackend& backendOf(const Field& field) noexcept {
    return Field::Impl::backendOf(field);
}

Error probesDoNotFit(const FieldDesc& desc) {
    return {ErrorCode::outOfMemory, sentence("no memory for ", probeCount(desc), " probes; use fewer or smaller ones")};
}

Field::Field(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
Field::Field(Field&&) noexcept = default;
Field& Field::operator=(Field&&) noexcept = default;
Field::~Field() = default;

FieldControl& Field::control() noexcept {
    return m_impl->control;
}
const FieldControl& Field::control() const noexcept {
    return m_impl->control;
}
std::uint64_t Field::fallbackQueries() const noexcept {
    return m_impl->backend->fallbackQueries();
}
FieldMemory Field::memory() const noexcept {
    FieldMemory memory = m_impl->backend->memory();
    memory.stateBytes += m_impl->books().bytes();
    return memory;
}

PackedRayDatum packRay(const RayDatum& datum) noexcept {
    return {kernels::packRadiance(kernels::unsignedRadiance(datum.distance, datum.radiance)),
            kernels::packRayDistance(datum.distance, datum.radiance.x)};
}

Result<UpdateTimes> Field::update(std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays) try {
    FieldControl::Impl& books = m_impl->books();
    if (rayData.size() != books.rayCount())
        return fail(ErrorCode::invalidArgument,
                    sentence("rayData has ", rayData.size(),
                             " entries; it must have tasks x raysPerProbe = ", books.rayCount()));
    if (!fixedRays.empty() && fixedRays.size() != books.fixedRayCount())
        return fail(ErrorCode::invalidArgument,
                    sentence("fixedRays has ", fixedRays.size(),
                             " entries; it must be empty or have an entry for each task and each of "
                             "fixedRayDirections(), ",
                             books.fixedRayCount()));
    if (auto told = m_impl->tellPlaces(); !told) return told.error();
    const UpdateFrame frame = fixedRays.empty() ? books.comingUpdateWithoutFixedRays() : books.comingUpdate();
    std::optional<FoundPlaces> found;
    if (books.states.hasNew())
        found = lookAround(m_impl->context, frame, books.states.placements(), books.states.moving(), rayData);
    auto times = m_impl->ended(frame.reportsProgress, m_impl->backend->update(frame, rayData, fixedRays));
    if (times && found) {
        m_impl->place(*found);
        if (auto told = m_impl->tellPlaces(); !told) return told.error();
    }
    return times;
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

Result<UpdateTimes> Field::update(std::span<const PackedRayDatum> rayData,
                                  std::span<const FixedRayDatum> fixedRays) try {
    std::vector<RayDatum> unpacked(rayData.size());
    parallelFor(m_impl->context, rayData.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const PackedRayDatum& d = rayData[i];
            unpacked[i] = {kernels::unpackRayRadiance(d.radiance, d.distance), d.distance};
        }
    });
    return update(unpacked, fixedRays);
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

Result<UpdateTimes> Field::update(const Tracer& tracer, const Lighting& lighting) try {
    if (auto ready = m_impl->prepare(tracer); !ready) return ready.error();
    const UpdateFrame frame = m_impl->books().comingUpdate();
    return m_impl->ended(frame.reportsProgress, m_impl->backend->update(frame, tracer, lighting));
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

Result<ConvergeResult> Field::converge(const Tracer& tracer, const Lighting& lighting, float tolerance, int maxFrames,
                                       const std::function<void(const UpdateTimes&)>& onUpdate) try {
    return m_impl->converge(tracer, lighting, {tolerance, maxFrames, onUpdate, nullptr});
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

Result<ConvergeResult> Field::converge(const Tracer& tracer, const Lighting& lighting, ConvergeState& state,
                                       float tolerance, int maxFrames,
                                       const std::function<void(const UpdateTimes&)>& onUpdate) try {
    return m_impl->converge(tracer, lighting, {tolerance, maxFrames, onUpdate, &state});
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

glm::vec3 Field::irradiance(const FieldQuery& query) const noexcept {
    return m_impl->backend->irradiance(m_impl->control.settings(), query);
}

Result<void> Field::irradiance(std::span<const FieldQuery> queries, std::span<glm::vec3> out) const try {
    if (queries.size() != out.size())
        return fail(ErrorCode::invalidArgument, sentence("there are ", queries.size(), " queries and room for ",
                                                         out.size(), " answers; both spans must be equally long"));
    return m_impl->backend->irradiance(m_impl->control.settings(), queries, out);
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory for this many queries; ask for fewer at a time");
}

Result<void> Field::scroll(int volume, glm::ivec3 cells) try {
    Impl& m = *m_impl;
    auto placement = m.books().scrolledBy(volume, cells);
    if (!placement) return placement.error();
    m.swapPlacement(*placement);
    auto entered = m.enter(volume, cells);
    if (!entered) m.swapPlacement(*placement);
    return entered;
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoScrollMemory);
}

Result<void> Field::followCamera(glm::vec3 camera) try {
    FieldControl::Impl& books = m_impl->books();
    const auto cells = books.cellsAfter(camera);
    if (!cells) return cells.error();
    for (std::size_t i = 0; i < cells->size(); ++i)
        if ((*cells)[i] != glm::ivec3(0))
            if (auto scrolled = scroll(int(i), (*cells)[i]); !scrolled) return scrolled;
    books.settings.camera = camera;
    books.chooseTasks();
    return {};
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoScrollMemory);
}

Result<FieldSnapshot> Field::read() const {
    return read({0, probeCount(desc())});
}

Result<FieldSnapshot> Field::read(SlotRange slots) const try {
    if (auto ok = validateSlots(desc(), slots); !ok) return ok.error();
    auto snapshot = m_impl->backend->read(slots);
    if (snapshot) m_impl->books().describe(*snapshot);
    return snapshot;
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, sentence("no memory for a snapshot of ", slots.count, " probes"));
}

Result<void> Field::write(const FieldSnapshot& snapshot) try {
    if (auto ok = validateSnapshot(desc(), snapshot); !ok) return ok;
    Impl& m = *m_impl;
    auto placement = m.books().placementOf(snapshot);
    if (!placement) return placement.error();
    if (auto written = m.backend->write(snapshot); !written) return written;
    m.books().goOnFrom(snapshot);
    m.swapPlacement(*placement);
    return {};
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory to write the snapshot");
}

}  // namespace probegi
