#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "animation/frame_pattern.h"
#include "animation/video_file.h"
#include "aov.h"
#include "console/output.h"
#include "render_options.h"

namespace probegi::tool {

/// Where an animation's pictures go: numbered files or a video.
class PictureSink {
public:
    /// Checks -o and --stats before any work. Errors: invalidArgument, unsupported, writeFailed.
    static Result<PictureSink> create(const RenderOptions& options, const FrameTimes& times);

    /// Errors: invalidArgument if a file to be written is one of those that are read.
    Result<void> keepApartFrom(const std::vector<std::filesystem::path>& inputs) const;

    /// The next picture. Errors: writeFailed.
    Result<void> add(const Picture& picture, const ToneMap& toneMap);
    /// After the last one. Errors: writeFailed.
    Result<void> finish();

    /// Whether an exposure acts on what is written.
    bool isShown() const;
    /// The file of a picture; the video's.
    std::string fileOf(int frame) const;

private:
    Result<void> addToVideo(const Picture& picture, const ToneMap& toneMap);

    Outputs m_outputs;
    std::string m_output;
    std::optional<FramePattern> m_pattern;  // empty: a video
    std::optional<VideoFile> m_video;       // begun by the first picture
    Aov m_aov = Aov::color;
    FrameTimes m_times;
    int m_written = 0;
};

}  // namespace probegi::tool
