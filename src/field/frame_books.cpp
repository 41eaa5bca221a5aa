#include "field/frame_books.h"

#include "kernels/ray_set.h"

namespace probegi {

namespace {

std::uint32_t seedOf(const FieldDesc& desc) {
    return kernels::hashCombine(std::uint32_t(desc.seed), std::uint32_t(desc.seed >> 32));
}

std::uint32_t ditherSeedOf(const FieldDesc& desc, int frame) {
    return kernels::hashCombine(seedOf(desc) ^ 0x6a09e667u, std::uint32_t(frame));
}

}  // namespace

FrameBooks::FrameBooks(const FieldDesc& desc) : m_desc(desc), m_directions(std::size_t(desc.raysPerProbe)) {
    turnRays();
}

void FrameBooks::turnRays() {
    const glm::mat3 rotation = kernels::frameRotation(seedOf(m_desc), std::uint32_t(m_frame));
    const std::uint32_t count = std::uint32_t(m_directions.size());
    for (std::uint32_t i = 0; i < count; ++i) m_directions[i] = rotation * kernels::sphericalFibonacci(i, count);
}

std::size_t FrameBooks::bytes() const noexcept {
    return sizeof(*this) + m_directions.capacity() * sizeof(m_directions[0]);
}

UpdateFrame FrameBooks::comingUpdate() const noexcept {
    return {.desc = m_desc,
            .directions = m_directions,
            .hysteresis = m_events.current(m_desc, m_frame == 0),
            .linear = false,
            .ditherSeed = ditherSeedOf(m_desc, m_frame),
            .bounces = m_frame > 0};
}

UpdateFrame FrameBooks::comingAverage(FrameHysteresis kept) const noexcept {
    UpdateFrame frame = comingUpdate();
    frame.hysteresis = kept;
    frame.linear = true;
    return frame;
}

void FrameBooks::advance(bool turn) {
    m_events.advance();
    ++m_frame;
    if (turn) turnRays();
}

}  // namespace probegi
