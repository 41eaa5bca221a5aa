#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "io/image_codec.h"
#include "io/refused.h"
#include "kernels/screen/colour.h"

namespace probegi::io {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// libjpeg-turbo's decoder for one picture.
class JpegReader {
public:
    explicit JpegReader(Bytes bytes) : m_bytes(bytes), m_handle(tjInitDecompress()) {
        if (!m_handle) refuse(ErrorCode::outOfMemory, "the JPEG decoder cannot start");
        int subsampling = 0;
        int colorSpace = 0;
        if (tjDecompressHeader3(m_handle.get(), bytes.data(), bytes.size(), &m_width, &m_height, &subsampling,
                                &colorSpace) != 0) {
            refuseDamaged();
        }
        checkImageSize(m_width, m_height, bytes.size());
        if (colorSpace == TJCS_CMYK || colorSpace == TJCS_YCCK) {
            refuse(ErrorCode::unsupported, "is a CMYK JPEG; save it as RGB");
        }
    }

    int width() const { return m_width; }
    int height() const { return m_height; }

    /// `out` has width x height x the format's bytes. Decoder warnings count as damage, except padding between
    /// segments, which some programs write.
    void decode(std::span<std::uint8_t> out, TJPF format) {
        // A progressive picture of a thousand scans would take hours.
        const int result = tjDecompress2(m_handle.get(), m_bytes.data(), m_bytes.size(), out.data(), m_width, 0,
                                         m_height, format, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS);
        if (result == 0) return;
        const std::string_view message = tjGetErrorStr2(m_handle.get());
        if (message.find("extraneous bytes before marker") == std::string_view::npos) refuseDamaged();
    }

private:
    struct Destroy {
        void operator()(void* handle) const { tjDestroy(handle); }
    };

    [[noreturn]] void refuseDamaged() {
        refuseMalformed("is not a readable JPEG ({}); save it again", tjGetErrorStr2(m_handle.get()));
    }

    Bytes m_bytes;
    std::unique_ptr<void, Destroy> m_handle;
    int m_width = 0;
    int m_height = 0;
};

}  // namespace

HdrImage decodeJpeg(Bytes bytes, const ReadLimits& limits) {
    JpegReader reader(bytes);
    HdrImage image = emptyImage(reader.width(), reader.height(), bytes.size(), limits);
    std::vector<std::uint8_t> codes(3 * std::size_t(reader.width()) * std::size_t(reader.height()));
    reader.decode(codes, TJPF_RGB);
    std::array<float, 256> linear{};
    for (std::size_t code = 0; code < linear.size(); ++code) linear[code] = kernels::decodeSrgb(float(code) / 255.0f);
    for (std::size_t i = 0; i < codes.size(); i += 3) {
        image.pixels.emplace_back(linear[codes[i]], linear[codes[i + 1]], linear[codes[i + 2]]);
    }
    return image;
}

std::uint64_t jpegPixels(Bytes bytes) {
    const JpegReader reader(bytes);
    return std::uint64_t(reader.width()) * std::uint64_t(reader.height());
}

TextureImage decodeJpegTexture(Bytes bytes) {
    JpegReader reader(bytes);
    TextureImage image;
    image.width = reader.width();
    image.height = reader.height();
    image.rgba.resize(4 * std::size_t(image.width) * std::size_t(image.height));
    reader.decode(image.rgba, TJPF_RGBA);
    return image;
}

}  // namespace probegi::io
