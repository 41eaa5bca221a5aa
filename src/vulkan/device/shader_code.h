#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace probegi::vulkan {

/// SPIR-V of shaders by name; empty for an unknown name. The build generates it (cmake/probegi_shaders.cmake).
using ShaderBook = std::span<const std::uint32_t> (*)(std::string_view name);

/// The library's own shaders: src/vulkan/shaders/NAME.comp, or NAME_TRACER for those compiled once per tracer.
std::span<const std::uint32_t> shaderCode(std::string_view name);

/// A compute shader: the name that identifies its pipeline, and where its code is found.
struct Shader {
    std::string name;
    ShaderBook book = shaderCode;

    Shader(const char* ofLibrary) : name(ofLibrary) {}
    Shader(std::string n, ShaderBook b) : name(std::move(n)), book(b) {}
};

}  // namespace probegi::vulkan
