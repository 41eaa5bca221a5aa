#pragma once

#include <cstring>

#include "kernels/abi/dispatch.h"
#include "vulkan/device/address.h"
#include "vulkan/device/device_impl.h"
#include "vulkan/device/memory.h"

namespace probegi::vulkan {

/// Records passes into a command buffer that it does not own. All passes share PassLayout.
class Recorder {
public:
    Recorder(const Device::Impl& device, VkCommandBuffer commands) : m_device(device), m_commands(commands) {}

    void bindVolume(vk::DescriptorSet set) const { bind(0, set); }
    void bindScene(vk::DescriptorSet set) const { bind(1, set); }

    template <class Push>
    void push(const Push& values) const {
        static_assert(sizeof(Push) <= PassLayout::kPushBytes && sizeof(Push) % 4 == 0);
        m_commands.pushConstants(*layout().pipeline, vk::ShaderStageFlagBits::eCompute, 0, sizeof(Push), &values,
                                 dispatcher());
    }

    /// Runs a pass over a grid of work groups.
    void dispatch(const Shader& shader, std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1,
                  std::span<const std::uint32_t> constants = {}) const {
        m_commands.bindPipeline(vk::PipelineBindPoint::eCompute, m_device.pipelines->get(shader, constants),
                                dispatcher());
        m_commands.dispatch(x, y, z, dispatcher());
    }
    /// Runs a pass over `count` threads. More groups than one axis allows are spread over
    /// two: shaders get their index from globalIndex() in shaders/common.glsl.
    void dispatchOver(const Shader& shader, std::uint64_t count) const {
        const kernels::uvec3 groups = kernels::threadGroups(std::uint32_t(count));
        if (count) dispatch(shader, groups.x, groups.y);
    }
    /// Runs a pass over `blocks` times `columns` groups. The block is spread over x and z (blockIndex() in
    /// shaders/common.glsl), since devices may limit an axis to 65,535 groups; the column is y.
    void dispatchOver(const Shader& shader, std::uint32_t blocks, std::uint32_t columns,
                      std::span<const std::uint32_t> constants = {}) const {
        const kernels::uvec3 groups = kernels::blockGroups(blocks, columns);
        dispatch(shader, groups.x, groups.y, groups.z, constants);
    }
    /// Runs a pass over a number of groups read from GPU memory: three words, `offset` bytes into the buffer.
    void dispatchIndirect(const Shader& shader, const Buffer& buffer, std::size_t offset,
                          std::span<const std::uint32_t> constants = {}) const {
        m_commands.bindPipeline(vk::PipelineBindPoint::eCompute, m_device.pipelines->get(shader, constants),
                                dispatcher());
        m_commands.dispatchIndirect(buffer.handle(), offset, dispatcher());
    }

    void copy(const Buffer& from, const Buffer& to, VkDeviceSize bytes, VkDeviceSize offset = 0) const {
        if (bytes) m_commands.copyBuffer(from.handle(), to.handle(), vk::BufferCopy(0, offset, bytes), dispatcher());
    }
    void fill(const Buffer& buffer, std::uint32_t value) const {
        m_commands.fillBuffer(buffer.handle(), 0, VK_WHOLE_SIZE, value, dispatcher());
    }
    /// Writes bytes `offset` bytes into the buffer by way of the command buffer, in pieces within vkCmdUpdateBuffer's
    /// limit. Both must be multiples of four.
    void write(const Buffer& buffer, std::span<const std::byte> bytes, std::size_t offset = 0) const {
        constexpr std::size_t kPiece = 65536;
        for (std::size_t at = 0; at < bytes.size(); at += kPiece)
            m_commands.updateBuffer(buffer.handle(), offset + at, std::min(kPiece, bytes.size() - at),
                                    bytes.data() + at, dispatcher());
    }

    /// Full barrier over all stages, for the ends of updates and uploads, which are few per frame.
    void orderAll() const {
        const auto access = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
        barrier(vk::PipelineStageFlagBits2::eAllCommands, access, vk::PipelineStageFlagBits2::eAllCommands, access);
    }
    void barrier(vk::PipelineStageFlags2 before, vk::AccessFlags2 written, vk::PipelineStageFlags2 after,
                 vk::AccessFlags2 used) const {
        const vk::MemoryBarrier2 memory(before, written, after, used);
        m_commands.pipelineBarrier2(vk::DependencyInfo({}, memory), dispatcher());
    }
    /// Between two compute passes, if the second reads or overwrites what the first wrote or read.
    void computeToCompute() const {
        barrier(vk::PipelineStageFlagBits2::eComputeShader, kShaderAccess, vk::PipelineStageFlagBits2::eComputeShader,
                kShaderAccess);
    }
    /// The same if the second reads its number of groups from what the first wrote.
    void computeToDispatch() const {
        barrier(vk::PipelineStageFlagBits2::eComputeShader, kShaderAccess,
                vk::PipelineStageFlagBits2::eComputeShader | vk::PipelineStageFlagBits2::eDrawIndirect,
                kShaderAccess | vk::AccessFlagBits2::eIndirectCommandRead);
    }
    void transferToCompute() const {
        barrier(vk::PipelineStageFlagBits2::eTransfer, vk::AccessFlagBits2::eTransferWrite,
                vk::PipelineStageFlagBits2::eComputeShader, kShaderAccess | vk::AccessFlagBits2::eUniformRead);
    }
    void computeToHost() const {
        barrier(vk::PipelineStageFlagBits2::eComputeShader, vk::AccessFlagBits2::eShaderWrite,
                vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
    }
    void transferToHost() const {
        barrier(vk::PipelineStageFlagBits2::eTransfer, vk::AccessFlagBits2::eTransferWrite,
                vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
    }

    vk::CommandBuffer commands() const noexcept { return m_commands; }
    const vk::raii::DeviceDispatcher& dispatcher() const noexcept { return *m_device.device.getDispatcher(); }
    const PassLayout& layout() const noexcept { return m_device.pipelines->layout(); }

    static constexpr vk::AccessFlags2 kShaderAccess =
        vk::AccessFlagBits2::eShaderRead | vk::AccessFlagBits2::eShaderWrite;

private:
    void bind(std::uint32_t number, vk::DescriptorSet set) const {
        m_commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout().pipeline, number, set, {},
                                      dispatcher());
    }
    const Device::Impl& m_device;
    vk::CommandBuffer m_commands;
};

/// Encloses a pass in timestamps and a debug label, if requested and available.
class PassScope {
public:
    PassScope(const Recorder& recorder, const Device::Impl& device, Profiler* profiler, const char* name);
    ~PassScope();
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;

private:
    const Recorder& m_recorder;
    const Device::Impl& m_device;
    Profiler* m_profiler;
};

template <class T>
std::span<const std::byte> bytesOf(const T& value) {
    return {reinterpret_cast<const std::byte*>(&value), sizeof(T)};
}

}  // namespace probegi::vulkan
