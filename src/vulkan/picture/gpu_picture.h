#pragma once

#include <span>

#include "vulkan/picture/shading.h"

namespace probegi::vulkan {

/// What a picture is of.
struct GpuPicture {
    Device device;
    const GpuScene& scene;
    const GpuLighting& lighting;
    const Field* field;   ///< may be null
    FieldPasses* volume;  ///< of the field
    const PictureDesc& desc;
    Bounds bounds{};  ///< of the scene; for contact light without a field
};

/// Takes a picture through a list of passes, in frames as kPicturePasses says; a frame of passes with neighbours has at
/// most `framePixels`, but for a row at least. `times.total` is unset. Throws, Failure with `cancelled` as well.
RenderedPicture runPicture(const Context& context, const GpuPicture& picture, std::span<const GpuPass> passes,
                           std::size_t framePixels = kFramePixels);

}  // namespace probegi::vulkan
