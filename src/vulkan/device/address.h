#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace probegi::vulkan {

/// A buffer's device address (or any 64-bit number) in the shaders' format.
constexpr glm::uvec2 packAddress(std::uint64_t address) noexcept {
    return {std::uint32_t(address), std::uint32_t(address >> 32)};
}

}  // namespace probegi::vulkan
