#ifdef PROBEGI_TEST_VULKAN
#include "vulkan/device/shader_code.h"

namespace probegi::vulkan {

std::span<const std::uint32_t> libraryShaderCode(std::string_view name);

std::span<const std::uint32_t> shaderCode(std::string_view name) {
    static constexpr std::uint32_t kQuery[] = {
#include "toy_query.inc"
    };
    return name == "query" ? kQuery : libraryShaderCode(name);
}

}  // namespace probegi::vulkan
#endif
