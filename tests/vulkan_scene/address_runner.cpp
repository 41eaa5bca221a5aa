#include "vulkan_scene/address_runner.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <vulkan/vulkan_raii.hpp>

namespace probegi::test {
namespace {

struct HostBuffer {
    vk::raii::Buffer buffer;
    vk::raii::DeviceMemory memory;
    std::byte* mapped;
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
    const vk::ApplicationInfo application("probegi vulkan_scene test", 1, nullptr, 0, VK_API_VERSION_1_3);
    return {context, vk::InstanceCreateInfo({}, &application)};
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
    vk::PhysicalDeviceVulkan12Features features12;
    features12.scalarBlockLayout = true;
    features12.bufferDeviceAddress = true;
    return {physical, vk::DeviceCreateInfo({}, queue, {}, {}, nullptr, &features12)};
}

}  // namespace

struct AddressRunner::Impl {
    vk::raii::Context context;
    vk::raii::Instance instance = makeInstance(context);
    vk::raii::PhysicalDevice physical = firstDevice(instance);
    std::uint32_t family = computeQueueFamily(physical);
    vk::raii::Device device = makeDevice(physical, family);
    vk::raii::Queue queue = device.getQueue(family, 0);
    std::map<std::uint64_t, HostBuffer> buffers;  // by address

    std::pair<std::uint64_t, HostBuffer> makeBuffer(vk::DeviceSize bytes) const {
        const auto usage = vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eShaderDeviceAddress;
        vk::raii::Buffer buffer(device, vk::BufferCreateInfo({}, bytes, usage));
        const auto needs = buffer.getMemoryRequirements();
        const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
        const auto type = hostMemoryType(physical, needs.memoryTypeBits);
        vk::raii::DeviceMemory memory(device, vk::MemoryAllocateInfo(needs.size, type, &flags));
        buffer.bindMemory(*memory, 0);
        auto* mapped = static_cast<std::byte*>(memory.mapMemory(0, bytes));
        const std::uint64_t address = device.getBufferAddress(vk::BufferDeviceAddressInfo(*buffer));
        return {address, HostBuffer{std::move(buffer), std::move(memory), mapped}};
    }
};

AddressRunner::AddressRunner(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
AddressRunner::AddressRunner(AddressRunner&&) noexcept = default;
AddressRunner& AddressRunner::operator=(AddressRunner&&) noexcept = default;
AddressRunner::~AddressRunner() = default;

Result<AddressRunner> AddressRunner::create() {
    try {
        return AddressRunner(std::make_unique<Impl>());
    } catch (const std::exception& error) {
        return fail(ErrorCode::unsupported, std::string("no Vulkan device could be opened: ") + error.what());
    }
}

std::uint64_t AddressRunner::uploadBytes(std::span<const std::byte> bytes) {
    auto made = m_impl->makeBuffer(std::max<vk::DeviceSize>(bytes.size(), 16));
    std::copy(bytes.begin(), bytes.end(), made.second.mapped);
    return m_impl->buffers.insert(std::move(made)).first->first;
}

void AddressRunner::downloadBytes(std::uint64_t address, std::span<std::byte> out) const {
    std::copy_n(m_impl->buffers.at(address).mapped, out.size(), out.begin());
}

void AddressRunner::run(std::span<const std::uint32_t> spirv, std::span<const std::byte> pushConstants,
                        int groups) const {
    const auto compute = vk::ShaderStageFlagBits::eCompute;
    const vk::raii::Device& device = m_impl->device;
    const vk::PushConstantRange range(compute, 0, std::uint32_t(pushConstants.size()));
    const vk::raii::PipelineLayout layout(device, vk::PipelineLayoutCreateInfo({}, {}, range));
    const vk::raii::ShaderModule module(device, vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, compute, *module, "main");
    const vk::raii::Pipeline pipeline(device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout));

    const vk::raii::CommandPool pool(device, vk::CommandPoolCreateInfo({}, m_impl->family));
    const vk::raii::CommandBuffers commands(device,
                                            vk::CommandBufferAllocateInfo(*pool, vk::CommandBufferLevel::ePrimary, 1));
    const auto& command = commands[0];
    command.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    command.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
    command.pushConstants<std::byte>(
        *layout, compute, 0,
        vk::ArrayProxy<const std::byte>(std::uint32_t(pushConstants.size()), pushConstants.data()));
    command.dispatch(std::uint32_t(groups), 1, 1);
    const vk::MemoryBarrier toHost(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead);
    command.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost, {}, toHost, {},
                            {});
    command.end();
    m_impl->queue.submit(vk::SubmitInfo({}, {}, *command));
    m_impl->queue.waitIdle();
}

}  // namespace probegi::test
