#include "vulkan/device/submitter.h"

namespace probegi::vulkan {

Submitter::Submitter(const vk::raii::Device& device, const vk::raii::Queue& queue, std::uint32_t family)
    : m_device(device),
      m_queue(queue),
      m_pool(device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer, family)),
      m_commands(device, vk::CommandBufferAllocateInfo(*m_pool, vk::CommandBufferLevel::ePrimary, 1)),
      m_fence(device, vk::FenceCreateInfo()) {}

void Submitter::run(const std::function<void(VkCommandBuffer)>& record) {
    const std::lock_guard lock(m_mutex);
    if (m_lost) throw vk::DeviceLostError("the device was lost before");
    const vk::raii::CommandBuffer& commands = m_commands.front();
    // Also resets it after a failed recording.
    commands.reset();
    m_device.resetFences(*m_fence);
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    record(*commands);
    commands.end();
    try {
        m_queue.submit(vk::SubmitInfo({}, {}, *commands), *m_fence);
    } catch (const vk::DeviceLostError&) {
        m_lost = true;
        throw;
    }
    wait();
}

void Submitter::wait() {
    try {
        // No overall time limit: if a driver hangs, the system resets it and reports the device as lost.
        while (m_device.waitForFences(*m_fence, true, 1'000'000'000) == vk::Result::eTimeout) {
        }
    } catch (const vk::SystemError& error) {
        // Whatever the reason, the commands may still be running, so nothing more may be submitted.
        m_lost = true;
        throw vk::DeviceLostError(error.what());
    }
}

}  // namespace probegi::vulkan
