// Small files that claim, or unpack to, many pixels: the memory used is limited by the file's size.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "io/image_codec.h"
#include "io/refused.h"
#include "support/memory.h"

namespace probegi::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::HasSubstr;

void append(Bytes& bytes, std::uint32_t bigEndian) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(std::uint8_t(bigEndian >> shift));
}

void appendChunk(Bytes& png, const char* name, const Bytes& data) {
    append(png, std::uint32_t(data.size()));
    const std::size_t at = png.size();
    png.insert(png.end(), name, name + 4);
    png.insert(png.end(), data.begin(), data.end());
    append(png, std::uint32_t(crc32(0, png.data() + at, uInt(png.size() - at))));
}

Bytes zeros(std::size_t count) {
    const Bytes plain(count, 0);
    uLongf size = compressBound(uLong(count));
    Bytes packed(size);
    EXPECT_EQ(compress2(packed.data(), &size, plain.data(), uLong(count), 9), Z_OK);
    packed.resize(size);
    return packed;
}

/// A grey PNG of `depth` bits per pixel.
Bytes makePng(std::uint32_t width, std::uint32_t height, std::uint8_t depth, const Bytes& packed,
              bool interlaced = false) {
    Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    Bytes header;
    append(header, width);
    append(header, height);
    header.insert(header.end(), {depth, 0, 0, 0, std::uint8_t(interlaced)});
    appendChunk(png, "IHDR", header);
    appendChunk(png, "IDAT", packed);
    appendChunk(png, "IEND", {});
    return png;
}

Result<HdrImage> decode(const Bytes& bytes, const ReadLimits& limits = {}) {
    return io::guarded("a picture", [&] { return io::decodeImage(bytes, io::ImageFormat::png, limits); });
}

TEST(HostilePicture, ASmallFileMayNotFillTheMemory) {
    // 16384 x 16384 black pixels that really are in the 33 kB: 3 GB.
    const Bytes png = makePng(16384, 16384, 1, zeros(std::size_t(16384) * 2049));
    ASSERT_LT(png.size(), 40'000u);
    const std::size_t before = peakMemory();
    const auto image = decode(png, {1024, "--unpack-limit"});
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::outOfMemory);
    EXPECT_THAT(image.error().message, HasSubstr("raise --unpack-limit (now 1024)"));
    EXPECT_LT(peakMemory() - before, std::size_t(64) << 20);
}

TEST(HostilePicture, ARaisedLimitLetsItPass) {
    const Bytes png = makePng(2048, 2048, 1, zeros(2048 * 257));  // 48 MB
    EXPECT_FALSE(decode(png, {40, "x"}));
    const auto image = decode(png, {49, "x"});
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->pixels.size(), std::size_t(2048) * 2048);
}

TEST(HostilePicture, DataBeyondThePixelsIsNotUnpacked) {
    const Bytes bomb = zeros(std::size_t(256) << 20);
    for (const bool interlaced : {false, true}) {
        const Bytes png = makePng(4, 4, 8, bomb, interlaced);
        const std::size_t before = peakMemory();
        const auto image = decode(png);
        ASSERT_FALSE(image);
        EXPECT_EQ(image.error().code, ErrorCode::malformed);
        EXPECT_THAT(image.error().message, HasSubstr("more data than pixels"));
        EXPECT_LT(peakMemory() - before, std::size_t(32) << 20);
    }
    EXPECT_FALSE(io::guarded("it", [&] { return io::decodeTexture(makePng(4, 4, 8, bomb)); }));
}

TEST(HostilePicture, ALittleBeyondThePixelsIsForgiven) {
    EXPECT_TRUE(decode(makePng(4, 4, 8, zeros(21))));
}

TEST(HostilePicture, MorePixelsThanAnyCompressionHolds) {
    const auto image = decode(makePng(12'384, 12'384, 8, zeros(100)));
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::malformed);
    EXPECT_THAT(image.error().message, HasSubstr("claims 12384 x 12384 pixels"));
    EXPECT_EQ(decode(makePng(60'000, 60'000, 8, zeros(100))).error().code, ErrorCode::outOfMemory);
}

TEST(HostilePicture, FewerPixelsThanClaimedFillNoMore) {
    // Claims 4096 x 4096 and has 16 rows, and a text that makes the file long enough for the claim to be plausible.
    Bytes png = makePng(4096, 4096, 8, zeros(16 * 4097));
    appendChunk(png, "tEXt", Bytes(10'000, 'x'));
    const std::size_t before = peakMemory();
    const auto image = decode(png);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::malformed);
    EXPECT_LT(peakMemory() - before, std::size_t(64) << 20);
}

TEST(HostilePicture, EveryKindOfPngIsRead) {
    // 9 x 5 white pixels of 1, 2, 4, 8 and 16 bits, interlaced or not.
    for (const int depth : {1, 2, 4, 8, 16}) {
        const std::size_t row = 1 + std::size_t(9 * depth + 7) / 8;
        Bytes plain(5 * row, 0xff);
        for (std::size_t y = 0; y < 5; ++y) plain[y * row] = 0;  // no filter
        uLongf size = compressBound(uLong(plain.size()));
        Bytes packed(size);
        ASSERT_EQ(compress2(packed.data(), &size, plain.data(), uLong(plain.size()), 9), Z_OK);
        packed.resize(size);
        const Bytes png = makePng(9, 5, std::uint8_t(depth), packed);
        const auto image = decode(png);
        ASSERT_TRUE(image) << depth << ": " << image.error().message;
        ASSERT_EQ(image->pixels.size(), 45u);
        for (const glm::vec3& pixel : image->pixels) EXPECT_EQ(pixel, glm::vec3(1.0f)) << depth;
        EXPECT_EQ(io::decodeTexture(png).rgba, Bytes(4 * 45, 255)) << depth;
    }
}

}  // namespace
}  // namespace probegi::test
