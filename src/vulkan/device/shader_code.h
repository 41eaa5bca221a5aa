#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace probegi::vulkan {

/// SPIR-V of shaders by their names; empty for an unknown name. The build makes them (cmake/probegi_shaders.cmake).
using ShaderBook = std::span<const std::uint32_t> (*)(std::string_view name);

/// The library's own: src/vulkan/shaders/NAME.comp, or NAME_TRACER where there is one for each tracer.
std::span<const std::uint32_t> shaderCode(std::string_view name);

/// A compute shader: what its pipeline is known by, and where its code stands.
struct Shader {
    std::string name;
    ShaderBook book = shaderCode;

    Shader(const char* ofLibrary) : name(ofLibrary) {}
    Shader(std::string n, ShaderBook b) : name(std::move(n)), book(b) {}
};

}  // namespace probegi::vulkan
