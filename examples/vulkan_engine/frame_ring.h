#pragma once

#include <probegi/vulkan.h>

#include <array>
#include <map>
#include <string>

#include "engine_device.h"

/// Two frames in flight: the command buffer, fence and timestamps of each.
class FrameRing {
public:
    struct Frame {
        vk::raii::CommandBuffer commands;
        vk::raii::Fence done;
        probegi::vulkan::Profiler profiler;
    };

    FrameRing(const EngineDevice& engine, const probegi::vulkan::Device& device);
    FrameRing(const FrameRing&) = delete;
    FrameRing& operator=(const FrameRing&) = delete;
    ~FrameRing() { vkDeviceWaitIdle(*m_engine.device()); }

    /// Waits until the GPU has finished with the next frame, and returns it with its command buffer in recording state.
    Frame& begin();
    void submit();
    /// Waits until all submissions have finished.
    void wait();
    /// Mean milliseconds of each pass since the beginning.
    void printTimes() const;

private:
    Frame makeFrame(const probegi::vulkan::Device& device) const;
    void finish(Frame& frame);

    const EngineDevice& m_engine;
    vk::raii::CommandPool m_pool;
    std::array<Frame, 2> m_frames;
    std::size_t m_current = 1;
    std::map<std::string, std::pair<double, int>> m_times;  // sum, count
};
