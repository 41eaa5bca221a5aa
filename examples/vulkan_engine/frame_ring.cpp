#include "frame_ring.h"

#include <cstdio>

using namespace probegi::vulkan;

FrameRing::FrameRing(const EngineDevice& engine, const Device& device)
    : m_engine(engine),
      m_pool(engine.device(), {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, engine.family()}),
      m_frames{makeFrame(device), makeFrame(device)} {}

FrameRing::Frame FrameRing::makeFrame(const Device& device) const {
    const vk::CommandBufferAllocateInfo one(*m_pool, vk::CommandBufferLevel::ePrimary, 1);
    return {std::move(vk::raii::CommandBuffers(m_engine.device(), one).front()),
            vk::raii::Fence(m_engine.device(), vk::FenceCreateInfo(vk::FenceCreateFlagBits::eSignaled)),
            Profiler::create(device).value()};
}

void FrameRing::finish(Frame& frame) {
    const vk::Result waited = m_engine.device().waitForFences(*frame.done, true, UINT64_MAX);
    if (waited != vk::Result::eSuccess) vk::throwResultException(waited, "waiting for a frame");
}

FrameRing::Frame& FrameRing::begin() {
    m_current = 1 - m_current;
    Frame& frame = m_frames[m_current];
    finish(frame);
    // The profiler can be read when its command buffer has finished, until that is recorded again.
    const std::vector<PassTime> times = frame.profiler.read().value();
    for (const PassTime& pass : times) {
        m_times[pass.name].first += pass.milliseconds;
        ++m_times[pass.name].second;
    }
    m_engine.device().resetFences(*frame.done);
    frame.commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    frame.profiler.recordReset(*frame.commands);
    return frame;
}

void FrameRing::submit() {
    const Frame& frame = m_frames[m_current];
    frame.commands.end();
    const vk::CommandBufferSubmitInfo commands(*frame.commands);
    m_engine.queue().submit2(vk::SubmitInfo2({}, {}, commands), *frame.done);
}

void FrameRing::wait() {
    for (Frame& frame : m_frames) finish(frame);
}

void FrameRing::printTimes() const {
    for (const auto& [name, sum] : m_times) std::printf("  %-17s %8.3f ms\n", name.c_str(), sum.first / sum.second);
}
