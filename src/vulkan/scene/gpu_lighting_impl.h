#pragma once

#include "kernels/abi/gpu_passes.h"
#include "vulkan/device/staging.h"

namespace probegi::vulkan {

struct GpuLighting::Impl {
    Impl(const Device& device, const Lighting& lighting, int maxLights);

    /// Address of a LightingBlock.
    VkDeviceAddress address() const noexcept { return block.address(); }
    kernels::LightingBlock describe(const Lighting& lighting) const;

    Device device;
    int capacity;  // lights
    int skyWidth, skyHeight;
    Buffer lights, skyPixels, block;
    Staging staging;
    // Sources of the staged copies.
    std::vector<kernels::GpuLight> packed;
    std::vector<glm::vec3> pixels;
    std::vector<kernels::LightingBlock> described;
};

}  // namespace probegi::vulkan
