#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace probegi::vulkan {

/// SPIR-V of shaders/NAME.comp, or of its variant "NAME_VARIANT". Empty: there is no such shader. The definition is
/// made by cmake/probegi_shaders.cmake.
std::span<const std::uint32_t> shaderCode(std::string_view name);

}  // namespace probegi::vulkan
