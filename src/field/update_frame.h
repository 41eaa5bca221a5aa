#pragma once

#include <cstdint>
#include <span>

#include "field/hysteresis.h"
#include "kernels/trace/ray_set.h"
#include "kernels/volume/volume.h"
#include "probegi/field.h"

namespace probegi {

/// One update as a backend sees it: all that the field's books say of it.
struct UpdateFrame {
    const FieldDesc& desc;
    const FieldSettings& settings;
    std::span<const kernels::Volume> volumes;  ///< as they stand
    std::span<const ProbeTask> tasks;          ///< the probes to update; ray data are [task][ray]
    std::uint32_t taskList = 0;                ///< differs between lists of tasks
    std::span<const glm::vec3> directions{};   ///< unit, raysPerProbe of them
    FrameHysteresis hysteresis{};
    EventRegions events{};  ///< in which probes keep less than `hysteresis` or their windows say
    std::span<const kernels::EventLimit> limits{};  ///< the same by slot; empty: none
    bool reportsProgress = false;                   ///< FieldBackend::progress() is asked for, where there are windows
    bool linear = false;                            ///< kernels::blendLinear instead of blendEncoded
    bool windows = false;  ///< each probe at the rate of its own window, in place of `hysteresis`; linear is true then
    bool settles = false;  ///< probes and windows stay as an average left them, and what is seen is known from here on
    std::span<const glm::vec3> fixedDirections{};  ///< unit; of the rays that measure lag. Empty: none
    float longestWindow = 1;                       ///< updates, of irradiance
    float longestVisibilityWindow = 1;             ///< updates, of distance moments
    std::uint32_t ditherSeed = 0;                  ///< differs between frames
    std::uint32_t raySeed = 0;   ///< of random choices besides the directions: the same as long as the rays are
    bool bounces = true;         ///< whether the probes hold light of an earlier update
    kernels::RaySet nextRays{};  ///< of the update after this one

    /// Whether all of the field's probes are updated, in the order of their slots.
    bool whole() const noexcept { return taskList == 0; }
    bool hasEvents() const noexcept { return !events.empty() || !limits.empty(); }
    /// What announced changes leave a probe.
    kernels::EventLimit limitOf(const ProbeTask& task) const noexcept {
        const kernels::EventLimit limit = limits.empty() ? kernels::noEventLimit() : limits[task.slot];
        return events.limitAt(task.origin, limit);
    }
};

}  // namespace probegi
