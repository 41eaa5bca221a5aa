#pragma once

#include <vector>

#include "probegi/reference.h"
#include "reference/running_stats.h"
#include "reference/transport.h"

namespace probegi {

/// Averages paths into a picture. Threads may add to different pixels concurrently.
class Film {
public:
    Film(int width, int height);

    std::size_t pixelCount() const noexcept { return m_pixels.size(); }
    void add(std::size_t pixel, const PathResult& path) noexcept;
    /// Mean standard error of the luminance over the mean luminance; infinite before the second sample.
    double relativeError() const noexcept;
    /// Non-finite paths; they count as black. More than a handful would be a bug.
    std::int64_t rejectedCount() const noexcept;
    /// Copies the picture; the film can continue. Seconds and samplesPerPixel are set by the caller.
    ReferencePicture develop() const;

private:
    struct Pixel {
        RunningStats color;
        PathResult mean;  ///< all layers
        std::int32_t rejected = 0;
    };

    int m_width;
    int m_height;
    std::vector<Pixel> m_pixels;
};

}  // namespace probegi
