#pragma once

#include <functional>
#include <mutex>

#include "vulkan/device/vk.h"

namespace probegi::vulkan {

/// Records, submits and waits, one command buffer at a time: for programs without a frame loop. Thread-safe. A lost
/// device stays lost: later runs throw vk::DeviceLostError without touching it.
class Submitter {
public:
    Submitter(const vk::raii::Device& device, const vk::raii::Queue& queue, std::uint32_t family);

    /// Throws the exceptions of `record` and of Vulkan-Hpp.
    void run(const std::function<void(VkCommandBuffer)>& record);

private:
    void wait();

    const vk::raii::Device& m_device;
    const vk::raii::Queue& m_queue;
    vk::raii::CommandPool m_pool;
    vk::raii::CommandBuffers m_commands;
    vk::raii::Fence m_fence;
    std::mutex m_mutex;
    bool m_lost = false;
};

}  // namespace probegi::vulkan
