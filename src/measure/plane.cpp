#include "measure/plane.h"

#include <algorithm>

namespace probegi {

Plane filterRows(const Plane& plane, std::span<const float> taps) {
    const int radius = int(taps.size() / 2);
    Plane out(plane.width, plane.height);
    std::vector<float> padded(std::size_t(plane.width + 2 * radius));
    for (int y = 0; y < plane.height; ++y) {
        const float* from = plane.row(y);
        std::fill_n(padded.begin(), radius, from[0]);
        std::copy_n(from, plane.width, padded.begin() + radius);
        std::fill_n(padded.end() - radius, radius, from[plane.width - 1]);
        float* to = out.row(y);
        for (std::size_t tap = 0; tap < taps.size(); ++tap) {
            const float weight = taps[tap];
            const float* shifted = padded.data() + tap;
            for (int x = 0; x < plane.width; ++x) to[x] += weight * shifted[x];
        }
    }
    return out;
}

Plane filterColumns(const Plane& plane, std::span<const float> taps) {
    const int radius = int(taps.size() / 2);
    Plane out(plane.width, plane.height);
    for (int y = 0; y < plane.height; ++y) {
        float* to = out.row(y);
        for (std::size_t tap = 0; tap < taps.size(); ++tap) {
            const float weight = taps[tap];
            const float* from = plane.row(std::clamp(y + int(tap) - radius, 0, plane.height - 1));
            for (int x = 0; x < plane.width; ++x) to[x] += weight * from[x];
        }
    }
    return out;
}

}  // namespace probegi
