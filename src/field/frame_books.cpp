#include "field/frame_books.h"

#include "kernels/blend/temporal_filter.h"
#include "kernels/trace/ray_set.h"

namespace probegi {

namespace {

std::uint32_t seedOf(const FieldDesc& desc) {
    return kernels::hashCombine(std::uint32_t(desc.seed), std::uint32_t(desc.seed >> 32));
}

// The window whose rate is what a hysteresis lets in.
float windowOf(float hysteresis) {
    return 1.0f / (1.0f - hysteresis);
}

std::uint32_t ditherSeedOf(const FieldDesc& desc, int frame) {
    return kernels::hashCombine(seedOf(desc) ^ 0x6a09e667u, std::uint32_t(frame));
}

}  // namespace

FrameBooks::FrameBooks(const FieldDesc& desc) : m_desc(desc), m_directions(std::size_t(desc.raysPerProbe)) {
    turnRays();
    const std::uint32_t fixed = desc.rules == FieldRules::measured ? std::uint32_t(desc.fixedRays) : 0u;
    for (std::uint32_t i = 0; i < fixed; ++i) m_fixedDirections.push_back(kernels::sphericalFibonacci(i, fixed));
}

void FrameBooks::turnRays() {
    const bool shifted = m_desc.rules == FieldRules::measured && !m_averaging;
    const std::uint32_t count = std::uint32_t(m_directions.size()), frame = std::uint32_t(m_frame);
    const glm::mat3 rotation = kernels::frameRotation(seedOf(m_desc), shifted ? 0u : frame);
    const glm::vec2 shift = shifted ? kernels::frameShift(seedOf(m_desc), frame, count) : glm::vec2(0.5f, 0.0f);
    for (std::uint32_t i = 0; i < count; ++i) m_directions[i] = rotation * kernels::shiftedFibonacci(i, count, shift);
}

std::size_t FrameBooks::bytes() const noexcept {
    return sizeof(*this) + (m_directions.capacity() + m_fixedDirections.capacity()) * sizeof(m_directions[0]);
}

UpdateFrame FrameBooks::comingUpdate() const noexcept {
    UpdateFrame frame{.desc = m_desc,
                      .directions = m_directions,
                      .hysteresis = m_events.current(m_desc, m_frame == 0),
                      .ditherSeed = ditherSeedOf(m_desc, m_frame),
                      .raySeed = ditherSeedOf(m_desc, m_turns) ^ 0x85ebca6bu,
                      .bounces = m_frame > 0};
    if (m_desc.rules == FieldRules::paper) return frame;
    frame.linear = frame.windows = true;
    frame.fixedDirections = m_fixedDirections;
    // Where nothing would tell of a change, old light must fade all the same.
    frame.longestWindow = m_events.irradianceEvent() || m_fixedDirections.empty()
                              ? windowOf(frame.hysteresis.irradiance)
                              : kernels::kLongestWindow;
    frame.longestVisibilityWindow = m_events.visibilityEvent() || m_fixedDirections.empty()
                                        ? windowOf(frame.hysteresis.visibility)
                                        : kernels::kLongestVisibilityWindow;
    return frame;
}

UpdateFrame FrameBooks::comingUpdateWithoutFixedRays() const noexcept {
    UpdateFrame frame = comingUpdate();
    frame.fixedDirections = {};
    frame.longestWindow = windowOf(frame.hysteresis.irradiance);
    frame.longestVisibilityWindow = windowOf(frame.hysteresis.visibility);
    return frame;
}

UpdateFrame FrameBooks::comingAverage(FrameHysteresis kept) const noexcept {
    UpdateFrame frame = comingUpdate();
    frame.hysteresis = kept;
    frame.linear = true;
    frame.windows = false;
    frame.fixedDirections = {};
    return frame;
}

void FrameBooks::setAveraging(bool averaging) {
    m_averaging = averaging;
    turnRays();
}

void FrameBooks::advance(bool turn) {
    m_events.advance();
    ++m_frame;
    if (!turn) return;
    ++m_turns;
    turnRays();
}

}  // namespace probegi
