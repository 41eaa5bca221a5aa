#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "probegi/image.h"
#include "probegi/scene.h"

/// Picture files in memory. Every function throws Refused for bytes it cannot use.
namespace probegi::io {

enum class ImageFormat : std::uint8_t { exr, hdr, png, jpeg };

/// Linear pixels of a picture file; 8 and 16 bit formats are decoded as sRGB.
HdrImage decodeImage(std::span<const std::uint8_t> bytes, ImageFormat format, const ReadLimits& limits = {});

/// A PNG or JPEG, recognised by its first bytes, as a scene's texture.
TextureImage decodeTexture(std::span<const std::uint8_t> bytes);

/// Width x height of decodeTexture's result, without decoding.
std::uint64_t texturePixels(std::span<const std::uint8_t> bytes);

// One format each; the magic number has been checked.
HdrImage decodeExr(std::span<const std::uint8_t> bytes, const ReadLimits& limits = {});
HdrImage decodeHdr(std::span<const std::uint8_t> bytes, const ReadLimits& limits = {});
HdrImage decodePng(std::span<const std::uint8_t> bytes, const ReadLimits& limits = {});
HdrImage decodeJpeg(std::span<const std::uint8_t> bytes, const ReadLimits& limits = {});
TextureImage decodePngTexture(std::span<const std::uint8_t> bytes);
TextureImage decodeJpegTexture(std::span<const std::uint8_t> bytes);
std::uint64_t pngPixels(std::span<const std::uint8_t> bytes);
std::uint64_t jpegPixels(std::span<const std::uint8_t> bytes);

/// A picture of this size with its pixels reserved but not created, so that a file with fewer pixels than it claims
/// uses no more memory than it has. Refuses sizes beyond the limits.
HdrImage emptyImage(int width, int height, std::size_t fileBytes, const ReadLimits& limits);

/// 32-bit float R, G, B, ZIP-compressed.
std::vector<std::uint8_t> encodeExr(const HdrImage& image);

/// 8-bit sRGB through the tone map.
std::vector<std::uint8_t> encodePng(const HdrImage& image, const ToneMap& toneMap);

/// Refuses sizes beyond the documented 2^28 pixels, or implausible for so few bytes: the densest compression (deflate
/// of 1-bit pixels) packs about 8,000 pixels into a byte, so a file that claims more is malicious.
void checkImageSize(std::int64_t width, std::int64_t height, std::size_t fileBytes);

}  // namespace probegi::io
