#pragma once

#include "probegi/image.h"

namespace probegi::tool {

/// A picture that writeImage() stores as a PNG (exposure 1, no filmic curve) from which a web page reads linear values
/// back without a library: twice as high, in its upper half the high bytes and in its lower half the low bytes of each
/// channel as a half float, 0..65504. Seven bits of the mantissa are kept (0.4 %), so that the file stays small. What
/// is not a number or negative is 0.
HdrImage halfFloatPlanes(const HdrImage& image);

}  // namespace probegi::tool
