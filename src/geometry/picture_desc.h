#pragma once

#include "probegi/render.h"

namespace probegi {

/// Checks all values. Errors: invalidArgument.
Result<void> validatePictureDesc(const PictureDesc& desc);

/// All layers in this size, black.
Picture emptyPicture(int width, int height);

/// The outOfMemory error of all backends.
Error pictureDoesNotFit(const PictureDesc& desc);

}  // namespace probegi
