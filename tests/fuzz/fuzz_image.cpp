// Any bytes as a picture of each format: pixels or an error message, never a crash.
#include <cstddef>
#include <cstdint>

#include "io/image_codec.h"
#include "io/refused.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace probegi::io;
    for (const ImageFormat format : {ImageFormat::exr, ImageFormat::hdr, ImageFormat::png, ImageFormat::jpeg}) {
        (void)guarded("picture", [&] { return decodeImage({data, size}, format); });
    }
    (void)guarded("texture", [&] { return decodeTexture({data, size}); });
    return 0;
}
