#include "kernels_gpu/vulkan_runner.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <vulkan/vulkan_raii.hpp>

namespace probegi::test {
namespace {

/// A storage buffer in host-visible memory.
struct HostBuffer {
    vk::raii::Buffer buffer;
    vk::raii::DeviceMemory memory;
    vk::DeviceSize bytes;
};

std::uint32_t computeQueueFamily(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    for (std::uint32_t i = 0; i < families.size(); ++i) {
        if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return i;
    }
    throw vk::InitializationFailedError("the device has no compute queue");
}

std::uint32_t hostMemoryType(const vk::raii::PhysicalDevice& physical, std::uint32_t allowed) {
    const auto wanted = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    const auto properties = physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
        if ((allowed >> i & 1u) && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    }
    throw vk::FeatureNotPresentError("the device has no memory that the host can see");
}

vk::raii::PhysicalDevice firstDevice(const vk::raii::Instance& instance) {
    vk::raii::PhysicalDevices devices(instance);
    return std::move(devices.front());
}

vk::raii::Instance makeInstance(const vk::raii::Context& context) {
    const vk::ApplicationInfo application("probegi kernels_gpu test", 1, nullptr, 0, VK_API_VERSION_1_2);
    return {context, vk::InstanceCreateInfo({}, &application)};
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
    vk::PhysicalDeviceVulkan12Features features12;
    features12.scalarBlockLayout = true;
    return {physical, vk::DeviceCreateInfo({}, queue, {}, {}, nullptr, &features12)};
}

}  // namespace

struct VulkanRunner::Impl {
    vk::raii::Context context;
    vk::raii::Instance instance = makeInstance(context);
    vk::raii::PhysicalDevice physical = firstDevice(instance);
    std::uint32_t family = computeQueueFamily(physical);
    vk::raii::Device device = makeDevice(physical, family);
    vk::raii::Queue queue = device.getQueue(family, 0);
    std::string name = physical.getProperties().deviceName;

    HostBuffer makeBuffer(vk::DeviceSize bytes) const {
        vk::raii::Buffer buffer(device, vk::BufferCreateInfo({}, bytes, vk::BufferUsageFlagBits::eStorageBuffer));
        const auto needs = buffer.getMemoryRequirements();
        const auto type = hostMemoryType(physical, needs.memoryTypeBits);
        vk::raii::DeviceMemory memory(device, vk::MemoryAllocateInfo(needs.size, type));
        buffer.bindMemory(*memory, 0);
        return {std::move(buffer), std::move(memory), bytes};
    }

    void dispatch(std::span<const std::uint32_t> spirv, const HostBuffer& in, const HostBuffer& out,
                  std::span<const std::uint32_t> pushConstants, int groups) const;
};

void VulkanRunner::Impl::dispatch(std::span<const std::uint32_t> spirv, const HostBuffer& in, const HostBuffer& out,
                                  std::span<const std::uint32_t> pushConstants, int groups) const {
    const auto compute = vk::ShaderStageFlagBits::eCompute;
    const vk::DescriptorSetLayoutBinding bindings[] = {{0, vk::DescriptorType::eStorageBuffer, 1, compute},
                                                       {1, vk::DescriptorType::eStorageBuffer, 1, compute}};
    const vk::raii::DescriptorSetLayout setLayout(device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
    const vk::PushConstantRange range(compute, 0, std::uint32_t(pushConstants.size_bytes()));
    const vk::raii::PipelineLayout layout(device, vk::PipelineLayoutCreateInfo({}, *setLayout, range));
    const vk::raii::ShaderModule module(device, vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, compute, *module, "main");
    const vk::raii::Pipeline pipeline(device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout));

    const vk::DescriptorPoolSize poolSize(vk::DescriptorType::eStorageBuffer, 2);
    const vk::raii::DescriptorPool pool(
        device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, poolSize));
    const vk::raii::DescriptorSets sets(device, vk::DescriptorSetAllocateInfo(*pool, *setLayout));
    const vk::DescriptorBufferInfo infos[] = {{*in.buffer, 0, in.bytes}, {*out.buffer, 0, out.bytes}};
    device.updateDescriptorSets(vk::WriteDescriptorSet(*sets[0], 0, 0, vk::DescriptorType::eStorageBuffer, {}, infos),
                                {});

    const vk::raii::CommandPool commandPool(device, vk::CommandPoolCreateInfo({}, family));
    const vk::raii::CommandBuffers commands(
        device, vk::CommandBufferAllocateInfo(*commandPool, vk::CommandBufferLevel::ePrimary, 1));
    const auto& command = commands[0];
    command.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    command.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
    command.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, *sets[0], {});
    command.pushConstants<std::uint32_t>(
        *layout, compute, 0,
        vk::ArrayProxy<const std::uint32_t>(std::uint32_t(pushConstants.size()), pushConstants.data()));
    command.dispatch(std::uint32_t(groups), 1, 1);
    const vk::MemoryBarrier toHost(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead);
    command.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost, {}, toHost, {},
                            {});
    command.end();
    queue.submit(vk::SubmitInfo({}, {}, *command));
    queue.waitIdle();
}

VulkanRunner::VulkanRunner(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
VulkanRunner::VulkanRunner(VulkanRunner&&) noexcept = default;
VulkanRunner& VulkanRunner::operator=(VulkanRunner&&) noexcept = default;
VulkanRunner::~VulkanRunner() = default;

const std::string& VulkanRunner::deviceName() const noexcept {
    return m_impl->name;
}

Result<VulkanRunner> VulkanRunner::create() {
    try {
        return VulkanRunner(std::make_unique<Impl>());
    } catch (const std::exception& error) {
        return fail(ErrorCode::unsupported, std::string("no Vulkan device could be opened (") + error.what() +
                                                "); install mesa-vulkan-drivers, whose software device is enough");
    }
}

Result<void> VulkanRunner::run(std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> inputs,
                               std::span<std::uint32_t> outputs, std::span<const std::uint32_t> pushConstants,
                               int groups) const {
    try {
        const HostBuffer in = m_impl->makeBuffer(inputs.size_bytes());
        const HostBuffer out = m_impl->makeBuffer(outputs.size_bytes());
        std::memcpy(in.memory.mapMemory(0, in.bytes), inputs.data(), inputs.size_bytes());
        in.memory.unmapMemory();
        std::memcpy(out.memory.mapMemory(0, out.bytes), outputs.data(), outputs.size_bytes());
        out.memory.unmapMemory();
        m_impl->dispatch(spirv, in, out, pushConstants, groups);
        std::memcpy(outputs.data(), out.memory.mapMemory(0, out.bytes), outputs.size_bytes());
        out.memory.unmapMemory();
        return {};
    } catch (const std::exception& error) {
        return fail(ErrorCode::unsupported, std::string("the shader could not be run: ") + error.what());
    }
}

}  // namespace probegi::test
