#include "surface/picture_desc.h"

#include <fmt/format.h>

namespace probegi {

namespace {
constexpr int kMaxSide = 16384;
}

Result<void> validatePictureDesc(const PictureDesc& desc) {
    if (desc.width < 1 || desc.width > kMaxSide || desc.height < 1 || desc.height > kMaxSide)
        return fail(ErrorCode::invalidArgument, fmt::format("a picture of {}x{} pixels is not possible; each side must "
                                                            "be 1 to {}",
                                                            desc.width, desc.height, kMaxSide));
    if (desc.samplesPerAxis < 1 || desc.samplesPerAxis > 8)
        return fail(ErrorCode::invalidArgument,
                    fmt::format("samplesPerAxis is {}; it must be 1 to 8", desc.samplesPerAxis));
    return {};
}

Picture emptyPicture(int width, int height) {
    const HdrImage empty(width, height);
    return {empty, empty, empty, empty, empty, empty, empty};
}

Error pictureDoesNotFit(const PictureDesc& desc) {
    return {ErrorCode::outOfMemory,
            fmt::format("a picture of {}x{} pixels does not fit into memory; choose a smaller size", desc.width,
                        desc.height)};
}

}  // namespace probegi
