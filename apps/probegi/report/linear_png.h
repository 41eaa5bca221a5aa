#pragma once

#include "probegi/image.h"

namespace probegi::tool {

/// Encodes linear values for a PNG by writeImage() (exposure 1, no filmic curve) that a web page can decode without a
/// library. Each channel becomes a half float, 0..65504; the picture is twice as high, with the high bytes in its upper
/// half and the low bytes in its lower half. Seven bits of mantissa are kept (0.4 %), so that the file stays small. NaN
/// and negative values become 0.
HdrImage halfFloatPlanes(const HdrImage& image);

}  // namespace probegi::tool
