#include "field/hysteresis.h"

#include <algorithm>

namespace probegi {

namespace {
constexpr int kSmallLightFrames = 4;
constexpr int kLargeFrames = 10;
constexpr int kVisibilityFrames = 7;
}  // namespace

void HysteresisSchedule::notify(FieldEvent event) noexcept {
    switch (event) {
        case FieldEvent::smallLightChange:
            m_smallLight.framesLeft = kSmallLightFrames;
            break;
        case FieldEvent::largeLightChange:
            m_large.framesLeft = kLargeFrames;
            break;
        case FieldEvent::largeObjectChange:
            m_large.framesLeft = kLargeFrames;
            m_visibility.framesLeft = kVisibilityFrames;
            break;
    }
}

FrameHysteresis HysteresisSchedule::current(const FieldDesc& desc, bool firstFrame) const noexcept {
    if (firstFrame) return {};
    const auto factor = [](const Reduction& r) { return r.framesLeft > 0 ? r.factor : 1.0f; };
    // Of overlapping events, the stronger one applies.
    return {desc.hysteresis * std::min(factor(m_smallLight), factor(m_large)),
            desc.visibilityHysteresis * factor(m_visibility)};
}

void HysteresisSchedule::advance() noexcept {
    for (Reduction* r : {&m_smallLight, &m_large, &m_visibility}) r->framesLeft = std::max(0, r->framesLeft - 1);
}

}  // namespace probegi
