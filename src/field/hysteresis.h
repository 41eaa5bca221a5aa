#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kernels/blend/event_region.h"
#include "probegi/control.h"

namespace probegi {

/// Shares of the old values that the next update keeps.
struct FrameHysteresis {
    float irradiance = 0;
    float visibility = 0;
};

/// The boxes in which an update keeps less of the old values than elsewhere.
struct EventRegions {
    std::array<kernels::EventRegion, kernels::kMostEventRegions> boxes{};
    int count = 0;

    bool empty() const noexcept { return count == 0; }
    std::span<const kernels::EventRegion> all() const noexcept { return {boxes.data(), std::size_t(count)}; }
    /// What the boxes leave a probe that stands there, of what others leave it.
    kernels::EventLimit limitAt(glm::vec3 position,
                                kernels::EventLimit limit = kernels::noEventLimit()) const noexcept {
        for (const kernels::EventRegion& region : all()) kernels::addEventRegion(limit, region, position);
        return limit;
    }
};

/// Whether none of a box's numbers is a NaN.
bool isNumber(const Bounds& box) noexcept;

/// Updates for which the reductions of announced changes still last (section 4.3).
struct EventUpdates {
    std::uint8_t smallLight = 0, large = 0, visibility = 0;

    void add(FieldEvent event) noexcept;
    void join(const EventUpdates& other) noexcept;
    void advance() noexcept;
    bool over() const noexcept { return smallLight == 0 && large == 0 && visibility == 0; }
    /// Shares that the reductions leave of the settings' hysteresis; overlapping events: the stronger one counts.
    float irradianceFactor() const noexcept;
    float visibilityFactor() const noexcept;
    /// The same as limits; 1 where nothing lasts.
    kernels::EventLimit limit(const FieldSettings& settings) const noexcept;
};

/// Which hysteresis the coming update uses: that of the settings, lowered for a few frames after announced changes
/// (section 4.3: "reduce irradiance hysteresis by 15% for four frames", and so on), 0 for the first update. Changes
/// are announced for all probes or for those in a box.
class HysteresisSchedule {
public:
    void notify(FieldEvent event) noexcept;
    /// The same for the probes in a box. One without volume that is inside out holds none; one that is not a number
    /// counts for all. Of more than kMostEventRegions boxes at a time, those are joined that grow least.
    void notify(FieldEvent event, const Bounds& box) noexcept;
    /// The coming frame's values, of probes outside all boxes. Does not advance.
    FrameHysteresis current(const FieldSettings& settings, bool firstFrame) const noexcept;
    /// The coming frame's boxes.
    EventRegions regions(const FieldSettings& settings, bool firstFrame) const noexcept;
    /// Whether an announced change lowers the coming frame's irradiance hysteresis, outside all boxes.
    bool irradianceEvent() const noexcept { return m_everywhere.smallLight > 0 || m_everywhere.large > 0; }
    /// Whether one lowers its visibility hysteresis, outside all boxes.
    bool visibilityEvent() const noexcept { return m_everywhere.visibility > 0; }
    /// Ends the frame.
    void advance() noexcept;

private:
    struct Region {
        Bounds box;
        EventUpdates left;
    };

    EventUpdates m_everywhere;
    std::array<Region, kernels::kMostEventRegions> m_regions{};
    std::size_t m_count = 0;
};

}  // namespace probegi
