#pragma once

#include "probegi/render.h"

namespace probegi {

/// Checks size and supersampling. Errors: invalidArgument.
Result<void> validatePictureDesc(const PictureDesc& desc);

/// All layers of the size, black.
Picture emptyPicture(int width, int height);

/// outOfMemory, in the words of every backend.
Error pictureDoesNotFit(const PictureDesc& desc);

}  // namespace probegi
