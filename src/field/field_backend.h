#pragma once

#include "field/update_frame.h"

namespace probegi {

/// What Field::converge wants to know of every probe after an update.
struct ProbeLight {
    std::vector<float> brightness;      ///< mean stored radiance over directions and channels
    std::vector<float> backfaceShares;  ///< ProbeState::backfaceShare
};

/// The third axis of the pipeline: where a field's passes run and where its probes lie. FieldControl keeps the
/// books (probes, directions, hysteresis) and calls one of these. One thread updates at a time; queries may be
/// concurrent with each other. Functions that return a Result may throw std::bad_alloc, which Field turns into an
/// Error.
class FieldBackend {
public:
    virtual ~FieldBackend() = default;

    /// Blends ray data [task * raysPerProbe + ray] into the probes; `fixedRays` are [task * fixedRays + ray], or
    /// none. The lengths were checked: fixedRays is empty exactly where the frame's fixedDirections are.
    virtual Result<UpdateTimes> update(const UpdateFrame& frame, std::span<const RayDatum> rayData,
                                       std::span<const FixedRayDatum> fixedRays) = 0;
    /// Traces and shades the rays of the tasks, then blends.
    virtual Result<UpdateTimes> update(const UpdateFrame& frame, const Tracer& tracer, const Lighting& lighting) = 0;
    /// E in W m^-2 at each query.
    virtual Result<void> irradiance(const FieldSettings& settings, std::span<const FieldQuery> queries,
                                    std::span<glm::vec3> out) const = 0;
    /// The same for one; not a number where the backend failed.
    virtual glm::vec3 irradiance(const FieldSettings& settings, const FieldQuery& query) const noexcept = 0;
    virtual Result<ProbeLight> light() const = 0;

    /// The volumes stand elsewhere from now on: slots keep what they hold.
    virtual void place(std::span<const kernels::Volume> volumes) noexcept = 0;
    /// After place(): the probes that entered a volume with this step (kernels::hasEntered) are new (Field::scroll):
    /// their backface share is kernels::kNeverUpdated, and all else of them 0. An update keeps nothing of a probe that
    /// has had none before, whatever the frame's hysteresis.
    virtual Result<void> enter(const FieldSettings& settings, int volume, glm::ivec3 cells) = 0;

    /// Where the probes stand, by slot (kernels/volume/probe_offset.h, kernels/probe/probe_state.h), and those among
    /// them that are new from now on, as those that enter().
    virtual Result<void> setPlacements(const FieldSettings& settings, std::span<const std::uint32_t> placements,
                                       std::span<const std::uint32_t> renewed) = 0;

    /// The slots and the snapshot were checked.
    virtual Result<FieldSnapshot> read(SlotRange slots) const = 0;
    virtual Result<void> write(const FieldSnapshot& snapshot) = 0;

    /// What probes told in the last update that had them among its tasks and whose frame asked for it (UpdateFrame::
    /// reportsProgress), by slot. Empty: nothing is known; a budget then goes by what FieldControl knows.
    virtual std::span<const kernels::ProbeProgress> progress() const noexcept { return {}; }

    virtual FieldMemory memory() const noexcept = 0;
    virtual std::uint64_t fallbackQueries() const noexcept = 0;
};

/// A Field on a backend. The desc and settings must be valid.
Field makeFieldOn(const Context& context, const FieldDesc& desc, const FieldSettings& settings,
                  std::unique_ptr<FieldBackend> backend);
/// The backend of a Field.
const FieldBackend& backendOf(const Field& field) noexcept;
/// outOfMemory, in the words that every backend uses where its probes do not fit.
Error probesDoNotFit(const FieldDesc& desc);

}  // namespace probegi
