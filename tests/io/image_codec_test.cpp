// Variants of EXR, JPEG and PNG that writeImage does not produce.
#include "io/image_codec.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cstring>

#include "io/refused.h"
#include "support/memory.h"

namespace probegi::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::HasSubstr;

class Memory final : public Imf::OStream {
public:
    Memory() : Imf::OStream("memory") {}
    void write(const char data[], int count) override {
        bytes.resize(std::max(bytes.size(), at + std::size_t(count)));
        std::memcpy(bytes.data() + at, data, std::size_t(count));
        at += std::size_t(count);
    }
    std::uint64_t tellp() override { return at; }
    void seekp(std::uint64_t position) override { at = position; }
    Bytes bytes;
    std::size_t at = 0;
};

constexpr int kWidth = 5;
constexpr int kHeight = 3;

/// An EXR with these channels; the value of pixel i in channel c is i + 100 c. Its data window begins at (-2, 7).
Bytes makeExr(const std::vector<std::string>& channels, Imf::Compression compression = Imf::ZIP_COMPRESSION,
              bool tiled = false, Imf::PixelType type = Imf::FLOAT) {
    const Imath::V2i origin(-2, 7);
    const Imath::Box2i window(origin, origin + Imath::V2i(kWidth - 1, kHeight - 1));
    Imf::Header header(window, window);
    header.compression() = compression;
    if (tiled) header.setTileDescription(Imf::TileDescription(4, 4));
    Imf::FrameBuffer frame;
    std::vector<std::vector<float>> floats(channels.size());
    std::vector<std::vector<half>> halves(channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c) {
        for (int i = 0; i < kWidth * kHeight; ++i) {
            floats[c].push_back(float(i) + 100.0f * float(c));
            halves[c].push_back(half(floats[c].back()));
        }
        header.channels().insert(channels[c], Imf::Channel(type));
        void* first = type == Imf::HALF ? static_cast<void*>(halves[c].data()) : floats[c].data();
        const std::size_t size = type == Imf::HALF ? sizeof(half) : sizeof(float);
        frame.insert(channels[c], Imf::Slice::Make(type, first, window, size, size * kWidth));
    }
    Memory memory;
    if (tiled) {
        Imf::TiledOutputFile file(memory, header, 0);
        file.setFrameBuffer(frame);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(memory, header, 0);
        file.setFrameBuffer(frame);
        file.writePixels(kHeight);
    }
    return memory.bytes;
}

Result<HdrImage> decode(const Bytes& bytes, io::ImageFormat format = io::ImageFormat::exr) {
    return io::guarded("a picture", [&] { return io::decodeImage(bytes, format); });
}

TEST(ImageCodec, ReadsEveryKindOfExr) {
    using Imf::FLOAT, Imf::HALF;
    const std::vector<std::string> rgb{"R", "G", "B"};
    for (const Bytes& bytes :
         {makeExr(rgb), makeExr(rgb, Imf::NO_COMPRESSION), makeExr(rgb, Imf::RLE_COMPRESSION),
          makeExr(rgb, Imf::PIZ_COMPRESSION), makeExr(rgb, Imf::ZIPS_COMPRESSION),
          makeExr(rgb, Imf::ZIP_COMPRESSION, true), makeExr(rgb, Imf::ZIP_COMPRESSION, false, HALF),
          makeExr({"R", "G", "B", "A"}, Imf::ZIP_COMPRESSION, true, HALF)}) {
        const auto image = decode(bytes);
        ASSERT_TRUE(image) << image.error().message;
        ASSERT_EQ(image->width, kWidth);
        ASSERT_EQ(image->height, kHeight);
        for (int i = 0; i < kWidth * kHeight; ++i) {
            const auto value = float(i);
            EXPECT_EQ(image->pixels[std::size_t(i)], glm::vec3(value, value + 100, value + 200));
        }
    }
}

TEST(ImageCodec, GreyAndIncompleteExr) {
    const auto grey = decode(makeExr({"Y", "Z"}));
    ASSERT_TRUE(grey) << grey.error().message;
    EXPECT_EQ(grey->pixels[4], glm::vec3(4));
    const auto red = decode(makeExr({"R"}));
    ASSERT_TRUE(red) << red.error().message;
    EXPECT_EQ(red->pixels[4], glm::vec3(4, 0, 0));
}

TEST(ImageCodec, RefusesExrItCannotShow) {
    const auto refused = [](const Bytes& bytes, ErrorCode code, const char* words) {
        const auto image = decode(bytes);
        ASSERT_FALSE(image);
        EXPECT_EQ(image.error().code, code);
        EXPECT_THAT(image.error().message, HasSubstr(words));
    };
    refused(makeExr({"depth", "left.R"}), ErrorCode::unsupported, "depth left.R");
    refused(makeExr({"Y", "RY", "BY"}), ErrorCode::unsupported, "chroma");
    Bytes multi = makeExr({"R"});
    multi[5] |= 0x10;
    refused(multi, ErrorCode::unsupported, "multi-part");
    refused(Bytes(3, 1), ErrorCode::malformed, "too early");
    // A header that claims a picture of 2^30 pixels.
    Bytes huge = makeExr({"R"});
    const std::uint8_t name[] = "dataWindow";
    const auto at = std::search(huge.begin(), huge.end(), std::begin(name), std::end(name));
    ASSERT_NE(at, huge.end());
    const auto box = at + std::ptrdiff_t(sizeof("dataWindow") + sizeof("box2i") + 4);
    const std::int32_t lying[] = {0, 0, 32767, 32767};
    std::memcpy(&*box, lying, sizeof(lying));
    refused(huge, ErrorCode::outOfMemory, "32768 x 32768");
}

// The files are padded with zeros until their claims are plausible.
TEST(ImageCodec, ExrThatClaimsMuchFillsLittle) {
    const auto claiming = [](std::int32_t side) {
        Bytes exr = makeExr({"R", "G", "B"});
        const std::uint8_t name[] = "dataWindow";
        const auto at = std::search(exr.begin(), exr.end(), std::begin(name), std::end(name));
        const std::int32_t window[] = {0, 0, side - 1, side - 1};
        std::memcpy(&*(at + std::ptrdiff_t(sizeof("dataWindow") + sizeof("box2i") + 4)), window, sizeof(window));
        exr.resize(exr.size() + (1 << 20));
        return exr;
    };
    const std::size_t before = peakMemory();
    const auto beyond = decode(claiming(16384));
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().code, ErrorCode::outOfMemory);
    EXPECT_THAT(beyond.error().message, HasSubstr("out of proportion"));
    const auto within = decode(claiming(4096));
    ASSERT_FALSE(within);
    EXPECT_EQ(within.error().code, ErrorCode::malformed);
    EXPECT_LT(peakMemory() - before, std::size_t(64) << 20);
}

Bytes makeJpeg(int width, int height, bool progressive) {
    const Bytes pixels(3 * std::size_t(width) * std::size_t(height), 188);  // sRGB 188 is linear 0.5
    const tjhandle handle = tjInitCompress();
    unsigned char* data = nullptr;
    unsigned long size = 0;
    EXPECT_EQ(tjCompress2(handle, pixels.data(), width, 0, height, TJPF_RGB, &data, &size, TJSAMP_420, 95,
                          progressive ? TJFLAG_PROGRESSIVE : 0),
              0);
    const Bytes bytes(data, data + size);
    tjFree(data);
    tjDestroy(handle);
    return bytes;
}

// The format allows empty data chunks, even the first.
TEST(ImageCodec, PngThatBeginsItsDataWithAnEmptyChunk) {
    HdrImage image(2, 1);
    image.pixels = {{1, 0, 0}, {0, 1, 1}};
    Bytes png = io::encodePng(image, {});
    const std::uint8_t empty[] = {0, 0, 0, 0, 'I', 'D', 'A', 'T', 0x35, 0xaf, 0x06, 0x1e};
    const auto data = std::search(png.begin(), png.end(), empty + 4, empty + 8);
    ASSERT_NE(data, png.end());
    png.insert(data - 4, std::begin(empty), std::end(empty));  // before the length of the first chunk of data
    EXPECT_EQ(io::decodePng(png).pixels, image.pixels);
    EXPECT_EQ(io::decodePngTexture(png).rgba, Bytes({255, 0, 0, 255, 0, 255, 255, 255}));
}

TEST(ImageCodec, ReadsJpeg) {
    for (const bool progressive : {false, true}) {
        const Bytes bytes = makeJpeg(33, 17, progressive);
        const auto image = decode(bytes, io::ImageFormat::jpeg);
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, 33);
        EXPECT_EQ(image->height, 17);
        for (const glm::vec3& pixel : image->pixels) EXPECT_NEAR(pixel.y, 0.5f, 0.02f);
        const TextureImage texture = io::decodeTexture(bytes);
        EXPECT_EQ(texture.rgba.size(), std::size_t(4 * 33 * 17));
        EXPECT_EQ(texture.rgba[3], 255);
        EXPECT_EQ(io::texturePixels(bytes), 33u * 17u);
    }
}

TEST(ImageCodec, CmykJpegIsRefusedWithAMessage) {
    const Bytes pixels(4 * 16 * 16, 99);
    const tjhandle handle = tjInitCompress();
    unsigned char* data = nullptr;
    unsigned long size = 0;
    ASSERT_EQ(tjCompress2(handle, pixels.data(), 16, 0, 16, TJPF_CMYK, &data, &size, TJSAMP_444, 90, 0), 0);
    const Bytes bytes(data, data + size);
    tjFree(data);
    tjDestroy(handle);
    const auto image = decode(bytes, io::ImageFormat::jpeg);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::unsupported);
    EXPECT_THAT(image.error().message, HasSubstr("CMYK"));
}

TEST(ImageCodec, DamagedJpegNeverCrashes) {
    const Bytes whole = makeJpeg(40, 40, true);
    for (std::size_t length = 0; length + 2 < whole.size(); ++length) {
        EXPECT_FALSE(decode(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(length)), io::ImageFormat::jpeg));
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
        Bytes flipped = whole;
        flipped[at] ^= 0xff;
        (void)decode(flipped, io::ImageFormat::jpeg);
    }
}

TEST(ImageCodec, SizesBeyondTheLimitsAreRefused) {
    const auto check = [](std::int64_t width, std::int64_t height, std::size_t bytes) {
        const auto result = io::guarded("it", [&] { io::checkImageSize(width, height, bytes); });
        return result ? std::string() : result.error().message;
    };
    EXPECT_EQ(check(1, 1, 1), "");
    EXPECT_EQ(check(16384, 16384, 1 << 20), "");
    EXPECT_THAT(check(0, 5, 100), HasSubstr("0 x 5"));
    EXPECT_THAT(check(-3, 5, 100), HasSubstr("-3 x 5"));
    EXPECT_THAT(check(70000, 5, 1 << 30), HasSubstr("at most"));
    EXPECT_THAT(check(16384, 16385, 1 << 30), HasSubstr("2^28"));
    EXPECT_THAT(check(10000, 10000, 100), HasSubstr("claims"));
}

}  // namespace
}  // namespace probegi::test
