#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>
#include <memory>

#include "io/image_codec.h"
#include "io/refused.h"
#include "io/stb.h"

namespace probegi::io {

namespace {

struct FreeStb {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
};
template <class T>
using StbPixels = std::unique_ptr<T[], FreeStb>;

using Bytes = std::span<const std::uint8_t>;

[[noreturn]] void refuseDamaged() {
    const char* reason = stbi_failure_reason();
    refuseMalformed("is not a readable Radiance .hdr ({}); save it again", reason ? reason : "damaged");
}

struct Size {
    int width = 0;
    int height = 0;
};

Size checkedSize(Bytes bytes) {
    if (bytes.empty()) refuseMalformed("is empty");
    if (bytes.size() > INT_MAX) refuse(ErrorCode::outOfMemory, "a picture file of over 2 GiB is not supported");
    Size size;
    int channels = 0;
    if (!stbi_info_from_memory(bytes.data(), int(bytes.size()), &size.width, &size.height, &channels)) {
        refuseMalformed(
            "is not a readable Radiance .hdr: its header is damaged or claims over 2^28 pixels; save it again");
    }
    checkImageSize(size.width, size.height, bytes.size());
    return size;
}

/// Feeds stb's .hdr reader. Past the end stb would read zeros, which it treats as empty runs and loops for ever; it
/// gets ones instead, which make it stop, and the overrun is recorded.
struct HdrSource {
    Bytes bytes;
    std::size_t at = 0;
    bool pastEnd = false;

    static int read(void* user, char* out, int count) {
        auto& source = *static_cast<HdrSource*>(user);
        if (source.at >= source.bytes.size()) {
            source.pastEnd = true;
            std::memset(out, 0xff, std::size_t(count));
            return count;
        }
        const std::size_t some = std::min(std::size_t(count), source.bytes.size() - source.at);
        std::memcpy(out, source.bytes.data() + source.at, some);
        source.at += some;
        return int(some);
    }
    static void skip(void* user, int count) { static_cast<HdrSource*>(user)->at += std::size_t(count); }
    static int atEnd(void* user) {
        const auto& source = *static_cast<const HdrSource*>(user);
        return source.at >= source.bytes.size();
    }
};

}  // namespace

HdrImage decodeHdr(Bytes bytes, const ReadLimits& limits) {
    Size size = checkedSize(bytes);
    HdrImage image = emptyImage(size.width, size.height, bytes.size(), limits);
    HdrSource source{bytes};
    const stbi_io_callbacks callbacks{HdrSource::read, HdrSource::skip, HdrSource::atEnd};
    int channels = 0;
    const StbPixels<float> pixels(
        stbi_loadf_from_callbacks(&callbacks, &source, &size.width, &size.height, &channels, 3));
    if (source.pastEnd) refuseMalformed("is a Radiance .hdr picture that ends too early; save it again");
    if (!pixels) refuseDamaged();
    const std::size_t count = std::size_t(size.width) * std::size_t(size.height);
    for (std::size_t i = 0; i < count; ++i) {
        image.pixels.emplace_back(pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]);
    }
    return image;
}

}  // namespace probegi::io
