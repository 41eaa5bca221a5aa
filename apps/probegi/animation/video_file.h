#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "probegi/result.h"

namespace probegi::tool {

/// File name extensions of videos.
std::vector<std::string_view> videoExtensions();
bool isVideo(const std::filesystem::path& path);

/// A video that the ffmpeg program writes, in BT.709. The file appears whole in finish(), or not at all.
class VideoFile {
public:
    /// `framesPerSecond` > 0; sides in pixels. Errors: unsupported (ffmpeg is not installed), writeFailed.
    static Result<VideoFile> create(const std::filesystem::path& path, int width, int height, double framesPerSecond);
    VideoFile(VideoFile&&) noexcept;
    VideoFile& operator=(VideoFile&&) noexcept;
    ~VideoFile();

    /// The next picture, 8-bit sRGB, rows from the top, three bytes a pixel. Errors: writeFailed (with ffmpeg's
    /// reason).
    Result<void> add(std::span<const std::uint8_t> pixels);
    /// Errors: writeFailed.
    Result<void> finish();

private:
    struct Impl;
    explicit VideoFile(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Errors: unsupported if there is no ffmpeg program to write this file with.
Result<void> checkVideoWriter(const std::filesystem::path& path);

}  // namespace probegi::tool
