#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "vulkan/device/shader_code.h"
#include "vulkan/device/vk.h"

namespace probegi::vulkan {

/// The layout shared by all passes. Set 0: a volume. Set 1: a scene. Push constants: the pass's struct in
/// kernels/abi/gpu_passes.h, at most the 128 bytes that every device supports.
struct PassLayout {
    explicit PassLayout(const vk::raii::Device& device);

    static constexpr std::uint32_t kPushBytes = 128;
    vk::raii::Sampler sampler;  ///< of the atlases: linear, clamped
    vk::raii::DescriptorSetLayout volume;
    vk::raii::DescriptorSetLayout scene;
    vk::raii::PipelineLayout pipeline;
};

/// Compute pipelines by shader name, compiled on first use and cached in a file between runs.
class PipelineStore {
public:
    /// `folder` may be empty. A damaged file is ignored, as is one of another driver, with a `warning`.
    PipelineStore(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device,
                  std::filesystem::path folder, std::string& warning);

    const PassLayout& layout() const noexcept { return m_layout; }
    /// `constants`: specialisation constants 0, 1, ... Throws.
    vk::Pipeline get(const Shader& shader, std::span<const std::uint32_t> constants = {});
    /// Writes the file if it has changed, atomically. Throws Failure.
    void save();

private:
    const vk::raii::Device& m_device;
    PassLayout m_layout;
    std::filesystem::path m_file;
    vk::raii::PipelineCache m_cache;
    std::map<std::string, vk::raii::Pipeline> m_pipelines;
    bool m_changed = false;
    std::uint64_t m_savedSum = 0;  // checksum of the file's contents
};

}  // namespace probegi::vulkan
