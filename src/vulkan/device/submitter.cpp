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
    // Also out of the state in which a recording that failed left it.
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
        // A driver that hangs is reset by its system, which then says that the device is lost.
        while (m_device.waitForFences(*m_fence, true, 1'000'000'000) == vk::Result::eTimeout) {
        }
    } catch (const vk::SystemError& error) {
        // Whatever the reason: nobody knows whether the commands still run, so nothing may follow them.
        m_lost = true;
        throw vk::DeviceLostError(error.what());
    }
}

}  // namespace probegi::vulkan
