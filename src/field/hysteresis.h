#pragma once

#include "probegi/control.h"

namespace probegi {

/// Shares of the old values that the next update keeps.
struct FrameHysteresis {
    float irradiance = 0;
    float visibility = 0;
};

/// Which hysteresis the coming update uses: that of the settings, lowered for a few frames after announced changes
/// (section 4.3: "reduce irradiance hysteresis by 15% for four frames", and so on), 0 for the first update.
class HysteresisSchedule {
public:
    void notify(FieldEvent event) noexcept;
    /// The coming frame's values. Does not advance.
    FrameHysteresis current(const FieldSettings& settings, bool firstFrame) const noexcept;
    /// Whether an announced change lowers the coming frame's irradiance hysteresis.
    bool irradianceEvent() const noexcept { return m_smallLight.framesLeft > 0 || m_large.framesLeft > 0; }
    /// Whether one lowers its visibility hysteresis.
    bool visibilityEvent() const noexcept { return m_visibility.framesLeft > 0; }
    /// Ends the frame.
    void advance() noexcept;

private:
    struct Reduction {
        float factor;  ///< on the hysteresis
        int framesLeft;
    };
    Reduction m_smallLight{0.85f, 0};
    Reduction m_large{0.5f, 0};
    Reduction m_visibility{0.5f, 0};
};

}  // namespace probegi
