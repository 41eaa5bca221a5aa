#pragma once

#include <string_view>

#include "probegi/result.h"

namespace probegi::tool {

/// Most pictures of an animation.
inline constexpr int kMostFrames = 100000;

/// The moments of --animate, seconds into the scene's animations.
struct FrameTimes {
    double from = 0;
    double to = 0;
    double step = 1;

    /// Pictures, `to` included where a step meets it.
    int count() const;
    double at(int frame) const;
};

/// "A:B:STEP". Errors: invalidArgument: not three numbers, A after B, STEP not above 0, more than kMostFrames.
Result<FrameTimes> parseFrameTimes(std::string_view text);

}  // namespace probegi::tool
