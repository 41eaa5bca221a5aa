#include <png.h>

#include <bit>
#include <cstring>
#include <optional>

#include "io/budget.h"
#include "io/image_codec.h"
#include "kernels/screen/colour.h"

namespace probegi::io {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// libpng's allocations; freed even if the header is refused.
struct PngStructs {
    PngStructs() = default;
    ~PngStructs() { png_destroy_read_struct(&png, &info, nullptr); }
    PngStructs(const PngStructs&) = delete;
    PngStructs& operator=(const PngStructs&) = delete;

    png_structp png = nullptr;
    png_infop info = nullptr;
};

/// libpng's decoder for one picture, row by row, so memory grows only with the pixels present.
class PngReader {
public:
    explicit PngReader(Bytes bytes) : m_bytes(bytes) {
        m_png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
        m_info = m_png ? png_create_info_struct(m_png) : nullptr;
        if (!m_info) refuse(ErrorCode::outOfMemory, "the PNG decoder cannot start");
        readHeader();
        checkImageSize(width(), height(), bytes.size());
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    int width() const { return int(png_get_image_width(m_png, m_info)); }
    int height() const { return int(png_get_image_height(m_png, m_info)); }

    /// Four channels of 8 bits.
    void asRgba8() {
        run([this] {
            png_set_expand(m_png);
            png_set_scale_16(m_png);
            png_set_gray_to_rgb(m_png);
            png_set_add_alpha(m_png, 0xff, PNG_FILLER_AFTER);
        });
    }
    /// Three channels of 16 bits: lossless for either depth.
    void asRgb16() {
        run([this] {
            png_set_expand_16(m_png);
            png_set_gray_to_rgb(m_png);
            png_set_strip_alpha(m_png);
            if constexpr (std::endian::native == std::endian::little) png_set_swap(m_png);
        });
    }

    /// Calls sink(row) with the bytes of each row, from the top, then reads the file to its end.
    template <class Sink>
    void readRows(const Sink& sink) {
        m_passes = 1;
        run([this] {
            m_passes = png_set_interlace_handling(m_png);
            png_read_update_info(m_png, m_info);
        });
        const std::size_t rowBytes = png_get_rowbytes(m_png, m_info);
        const auto rows = std::size_t(height());
        // Interlaced rows arrive in pieces; the last pass completes them.
        std::vector<std::uint8_t> buffer(m_passes > 1 ? rows * rowBytes : rowBytes);
        for (int pass = 0; pass < m_passes; ++pass) {
            for (std::size_t y = 0; y < rows; ++y) {
                m_row = buffer.data() + (m_passes > 1 ? y * rowBytes : 0);
                // After the last row libpng reads all remaining image data.
                if (pass + 1 == m_passes && y + 1 == rows) m_surplusLeft = rowBytes + kMostSurplus;
                run([this] { png_read_row(m_png, m_row, nullptr); });
                if (pass + 1 == m_passes) sink(std::span<const std::uint8_t>(m_row, rowBytes));
            }
        }
        run([this] { png_read_end(m_png, nullptr); });
    }

private:
    static constexpr std::size_t kMostSurplus = 1 << 16;  // unpacks to 64 MB at most

    /// libpng exits by longjmp: `step` must not own anything.
    template <class Step>
    void run(const Step& step) {
        if (setjmp(png_jmpbuf(m_png)) != 0) {
            refuseMalformed("is not a readable PNG{} ({}); save it again", m_where, m_reason);
        }
        step();
    }

    void readHeader() {
        run([this] {
            png_set_read_fn(m_png, this, onRead);
            png_set_user_limits(m_png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // ours are checked elsewhere
            // Texts, profiles and the like, of any size, are skipped; the rest has at most 256 entries.
            png_set_keep_unknown_chunks(m_png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
            png_read_info(m_png, m_info);
        });
        m_where = "";
    }

    static PngReader& of(png_structp png) { return *static_cast<PngReader*>(png_get_error_ptr(png)); }

    static void onError(png_structp png, png_const_charp message) {
        std::strncpy(of(png).m_reason, message, sizeof(m_reason) - 1);
        png_longjmp(png, 1);
    }
    static void onWarning(png_structp, png_const_charp) {}

    static void onRead(png_structp png, png_bytep out, std::size_t count) {
        PngReader& reader = of(png);
        if (count > reader.m_bytes.size() - reader.m_at) png_error(png, "it ends too early");
        reader.countSurplus(count);
        std::memcpy(out, reader.m_bytes.data() + reader.m_at, count);
        reader.m_at += count;
    }

    /// Data after the last pixel is unpacked only to be checked; a file could have gigabytes of it.
    void countSurplus(std::size_t count) {
        constexpr std::uint32_t kImageData = 0x49444154;  // "IDAT"
        if (!m_surplusLeft || png_get_io_chunk_type(m_png) != kImageData) return;
        if (count > *m_surplusLeft) png_error(m_png, "it holds more data than pixels");
        *m_surplusLeft -= count;
    }

    Bytes m_bytes;
    std::size_t m_at = 0;
    std::optional<std::size_t> m_surplusLeft;  ///< bytes; once the last row is being read
    int m_passes = 1;
    std::uint8_t* m_row = nullptr;
    const char* m_where = ": its header is damaged or claims over 2^28 pixels";
    char m_reason[128] = {};
    PngStructs m_structs;
    png_structp& m_png = m_structs.png;
    png_infop& m_info = m_structs.info;
};

}  // namespace

HdrImage decodePng(Bytes bytes, const ReadLimits& limits) {
    PngReader reader(bytes);
    HdrImage image = emptyImage(reader.width(), reader.height(), bytes.size(), limits);
    reader.asRgb16();
    std::vector<float> linear(65536);
    for (std::size_t code = 0; code < linear.size(); ++code) linear[code] = kernels::decodeSrgb(float(code) / 65535.0f);
    reader.readRows([&](std::span<const std::uint8_t> row) {
        std::uint16_t codes[3];
        for (std::size_t at = 0; at < row.size(); at += sizeof(codes)) {
            std::memcpy(codes, row.data() + at, sizeof(codes));
            image.pixels.emplace_back(linear[codes[0]], linear[codes[1]], linear[codes[2]]);
        }
    });
    return image;
}

std::uint64_t pngPixels(Bytes bytes) {
    const PngReader reader(bytes);
    return std::uint64_t(reader.width()) * std::uint64_t(reader.height());
}

TextureImage decodePngTexture(Bytes bytes) {
    PngReader reader(bytes);
    TextureImage image;
    image.width = reader.width();
    image.height = reader.height();
    image.rgba.reserve(4 * std::size_t(image.width) * std::size_t(image.height));
    reader.asRgba8();
    reader.readRows(
        [&](std::span<const std::uint8_t> row) { image.rgba.insert(image.rgba.end(), row.begin(), row.end()); });
    return image;
}

}  // namespace probegi::io
