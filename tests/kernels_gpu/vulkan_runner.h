#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "probegi/result.h"

namespace probegi::test {

/// Dispatches one compute shader at a time on the first Vulkan device, which may be software Vulkan.
class VulkanRunner {
public:
    /// Errors: unsupported (no usable Vulkan device).
    static Result<VulkanRunner> create();
    VulkanRunner(VulkanRunner&&) noexcept;
    VulkanRunner& operator=(VulkanRunner&&) noexcept;
    ~VulkanRunner();

    const std::string& deviceName() const noexcept;

    /// Runs `groups` work groups with storage buffers `inputs` (binding 0) and `outputs` (binding 1, read and written)
    /// and push constants. Errors: unsupported (the driver failed).
    Result<void> run(std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> inputs,
                     std::span<std::uint32_t> outputs, std::span<const std::uint32_t> pushConstants, int groups) const;

    struct Impl;

private:
    explicit VulkanRunner(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

}  // namespace probegi::test
