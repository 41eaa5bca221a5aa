#include "animation/picture_sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

namespace probegi::tool {

namespace fs = std::filesystem;

namespace {

fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(path, error);
    return error ? path : canonical;
}

// All names of the pictures. They have one folder.
std::set<fs::path> pictureFiles(const FramePattern& pattern, int count) {
    const fs::path folder = resolved(pattern.name(0)).parent_path();
    std::set<fs::path> files;
    for (int i = 0; i < count; ++i) files.insert(folder / fs::path(pattern.name(i)).filename());
    return files;
}

std::vector<std::uint8_t> displayBytes(const HdrImage& image, const ToneMap& toneMap) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * image.pixels.size());
    for (const glm::vec3& pixel : image.pixels) {
        const glm::vec3 shown = toDisplay(pixel, toneMap);
        for (int c = 0; c < 3; ++c)
            bytes.push_back(std::uint8_t(std::lround(255.0f * std::clamp(shown[c], 0.0f, 1.0f))));
    }
    return bytes;
}

}  // namespace

Result<PictureSink> PictureSink::create(const RenderOptions& options, const FrameTimes& times) {
    PictureSink sink;
    sink.m_output = options.output;
    sink.m_aov = options.aov;
    sink.m_times = times;
    if (isVideo(options.output)) {
        if (auto claimed = sink.m_outputs.claim("-o", options.output); !claimed) return claimed.error();
        if (auto there = checkVideoWriter(options.output); !there) return there.error();
    } else {
        auto extensions = pictureExtensions();
        const auto videos = videoExtensions();
        extensions.insert(extensions.end(), videos.begin(), videos.end());
        const std::string extension = fs::path(options.output).extension().string();
        if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
            return fail(ErrorCode::unsupported,
                        fmt::format("-o '{}' must end in {}", options.output, fmt::join(extensions, " or ")));
        auto pattern = FramePattern::parse(options.output);
        if (!pattern) return pattern.error();
        sink.m_pattern = std::move(*pattern);
        if (auto claimed = sink.m_outputs.claim("-o", sink.m_pattern->name(0)); !claimed) return claimed.error();
    }
    if (options.stats.empty()) return sink;
    if (auto claimed = sink.m_outputs.claim("--stats", options.stats); !claimed) return claimed.error();
    if (sink.m_pattern && pictureFiles(*sink.m_pattern, times.count()).contains(resolved(options.stats)))
        return fail(ErrorCode::invalidArgument,
                    fmt::format("--stats '{}' is also one of the pictures; give it another name", options.stats));
    return sink;
}

Result<void> PictureSink::keepApartFrom(const std::vector<fs::path>& inputs) const {
    if (auto apart = m_outputs.keepApartFrom(inputs); !apart || !m_pattern) return apart;
    const std::set<fs::path> files = pictureFiles(*m_pattern, m_times.count());
    for (const fs::path& input : inputs)
        if (files.contains(resolved(input)))
            return fail(ErrorCode::invalidArgument,
                        fmt::format("a picture of -o '{}' would overwrite '{}', which is read; choose another name",
                                    m_output, input.string()));
    return {};
}

bool PictureSink::isShown() const {
    return isLight(m_aov) && !m_output.ends_with(".exr");
}

std::string PictureSink::fileOf(int frame) const {
    return m_pattern ? m_pattern->name(frame) : m_output;
}

Result<void> PictureSink::addToVideo(const Picture& picture, const ToneMap& toneMap) {
    const HdrImage shown = shownLayer(picture, m_aov);
    if (!m_video) {
        auto video = VideoFile::create(m_output, shown.width, shown.height, 1.0 / m_times.step);
        if (!video) return video.error();
        m_video = std::move(*video);
    }
    return m_video->add(displayBytes(shown, isLight(m_aov) ? toneMap : ToneMap()));
}

Result<void> PictureSink::add(const Picture& picture, const ToneMap& toneMap) {
    if (!m_pattern) return addToVideo(picture, toneMap);
    return writeAov(m_pattern->name(m_written++), picture, m_aov, toneMap, false);
}

Result<void> PictureSink::finish() {
    return m_video ? m_video->finish() : Result<void>();
}

}  // namespace probegi::tool
