#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "probegi/scene.h"

namespace probegi {

/// What a picture will show: probes that no pixel of it needs are updated more rarely.
struct BudgetView {
    PlacedCamera camera;          ///< metres, in the world; forward and up unit and at right angles
    float aspect = 16.0f / 9.0f;  ///< width over height of the picture, > 0
};

/// How much an update may cost (DDGI paper, section 8.1, leaves such budgets to future work), and how to spend it.
///
/// A quarter of the probes that the budget pays for are those that were not updated for longest, whatever they are:
/// with so many a frame, r, each of n active probes is updated at least once in n / r frames, rounded up. The others
/// are, in this order: probes that were never updated; those near announced changes (FieldControl::notify); and by
/// how far their light may be off - the change that they or their neighbours saw, and the noise of their average, as
/// radiance beside the mean of all probes, squared - times the frames since their update, times how near the camera
/// they are and whether the view shows what they light.
///
/// Probes that have converged - they see no change beyond the noise that is left, and that is below 1 % of the mean
/// light of all probes or their window is at its longest - pause: only the first quarter updates them, until they or a
/// neighbour see a change, or one is announced. So an update may cost less than its budget. With FieldRules::paper
/// nobody knows what probes see, and none pauses. Snapshots do not hold any of this: after Field::write all probes
/// count as young.
struct UpdateBudget {
    /// Rays of an update, >= 0: raysPerProbe, the fixed rays and emitterSamples of each probe that it updates. At least
    /// those of one probe; 0: no limit. Not counted: shadow rays at hits, and the rays that place new probes
    /// (FieldDesc::relocation, probeStates), once.
    std::int64_t rays = 0;
    /// Milliseconds of an update, >= 0, that are held on average: the number of probes follows from what probes cost in
    /// the updates before, and grows by at most a factor of two an update. At least one probe is updated; 0: no limit.
    /// An update of a Field measures itself; for others see FieldControl::reportTime. Results then depend on the
    /// machine.
    double milliseconds = 0;
    /// Empty: probes near FieldSettings::camera come first, where that is given.
    std::optional<BudgetView> view{};

    bool limits() const noexcept { return rays > 0 || milliseconds > 0; }
};

}  // namespace probegi
