#pragma once

#include <cstdint>
#include <vector>

#include "field/hysteresis.h"
#include "probegi/field.h"

namespace probegi {

/// One update as a backend sees it: what the books say of the coming frame.
struct UpdateFrame {
    const FieldDesc& desc;                  ///< with the guard of the day
    std::span<const glm::vec3> directions;  ///< unit, raysPerProbe of them
    FrameHysteresis hysteresis;
    bool linear = false;   ///< kernels::blendLinear instead of blendEncoded
    bool windows = false;  ///< each probe at the rate of its own window, in place of `hysteresis`; linear is true then
    std::span<const glm::vec3> fixedDirections{};  ///< unit; of the rays that measure lag. Empty: none
    float longestWindow = 1;                       ///< updates, of irradiance
    float longestVisibilityWindow = 1;             ///< updates, of distance moments
    std::uint32_t ditherSeed = 0;                  ///< differs between frames
    std::uint32_t raySeed = 0;  ///< of random choices besides the directions: the same as long as the rays are
    bool bounces = true;        ///< whether the probes hold light of an earlier update
};

/// What a volume of probes keeps from frame to frame besides its probes, the same on every backend: how many updates
/// there were, the coming one's ray directions and dither, and the hysteresis that events lower.
class FrameBooks {
public:
    /// The desc must be valid.
    explicit FrameBooks(const FieldDesc& desc);

    const FieldDesc& desc() const noexcept { return m_desc; }
    int frame() const noexcept { return m_frame; }  ///< updates so far
    std::span<const glm::vec3> rayDirections() const noexcept { return m_directions; }
    std::span<const glm::vec3> fixedRayDirections() const noexcept { return m_fixedDirections; }
    std::size_t bytes() const noexcept;

    void notify(FieldEvent event) noexcept { m_events.notify(event); }
    void setGuard(LeakGuard guard) noexcept { m_desc.guard = guard; }

    /// The coming update by the described rules: with windows, or, by the paper, in encoded space with the described
    /// hysteresis. Valid until advance().
    UpdateFrame comingUpdate() const noexcept;
    /// The same for ray data that come without fixed rays.
    UpdateFrame comingUpdateWithoutFixedRays() const noexcept;
    /// The coming update as part of an average in linear space, of whose old values `kept` survive.
    UpdateFrame comingAverage(FrameHysteresis kept) const noexcept;
    /// Whether the coming updates are part of an average. Their rays are turned, not shifted: an average follows
    /// bounces with one and the same set, which is best as it was published.
    void setAveraging(bool averaging);
    /// Ends the frame: after the update. Without `turn`, the coming update has the same rays again.
    void advance(bool turn = true);

private:
    void turnRays();

    FieldDesc m_desc;
    std::vector<glm::vec3> m_directions, m_fixedDirections;
    HysteresisSchedule m_events;
    int m_frame = 0;
    int m_turns = 0;  // of the rays
    bool m_averaging = false;
};

}  // namespace probegi
