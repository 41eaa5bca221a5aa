#pragma once

#include <span>

#include "render/frame_pass.h"

namespace probegi {

/// Takes a picture through a list of passes, in frames as kPicturePasses says; a frame of passes with neighbours has at
/// most `framePixels`, but for a row at least. Errors: cancelled, and those of the passes. Throws std::bad_alloc.
Result<RenderedPicture> runPicture(const Context& context, const PictureInputs& inputs,
                                   std::span<const FramePass> passes, std::size_t framePixels = kFramePixels);

}  // namespace probegi
