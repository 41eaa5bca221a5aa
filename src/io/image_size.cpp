#include "io/image_codec.h"
#include "io/refused.h"

namespace probegi::io {

void checkImageSize(std::int64_t width, std::int64_t height, std::size_t fileBytes) {
    constexpr std::int64_t kMaxSide = 65536;
    constexpr std::int64_t kMaxPixels = std::int64_t(1) << 28;
    constexpr std::int64_t kMaxPixelsPerByte = 16384;
    if (width < 1 || height < 1) refuseMalformed("the picture's size of {} x {} is not one", width, height);
    if (width > kMaxSide || height > kMaxSide || width * height > kMaxPixels) {
        refuse(ErrorCode::outOfMemory,
               "the picture has {} x {} pixels; at most {} a side and 2^28 in all are supported", width, height,
               kMaxSide);
    }
    if (width * height / kMaxPixelsPerByte > std::int64_t(fileBytes)) {
        refuseMalformed("claims {} x {} pixels in {} bytes, more than any compression allows", width, height,
                        fileBytes);
    }
}

}  // namespace probegi::io
