#pragma once

#include <glm/vec2.hpp>

#include "probegi/image.h"

namespace probegi::tool {

/// Where a picture's indirect light is not the reference's, in square tiles that are wide enough for the reference's
/// noise to average out. Why there is too much light it does not know: whether it came through a wall, or a shadow is
/// finer than the probes' spacing.
struct LeakMap {
    HdrImage picture;     ///< display values as linear ones: the scene dimmed, red where it has too much light, blue
                          ///< where too little, and the tiles that leak in full red
    HdrImage ratio;       ///< of each pixel's tile: indirect light over the reference's, in all channels; 1 where noise
                          ///< could explain the difference
    int tiles = 0;        ///< in all
    int leaks = 0;        ///< tiles whose light is at least kLeakRatio times what is there, visibly and beyond noise
    double worst = 1;     ///< the largest such ratio, at most kLargestRatio; 1 where nothing leaks
    glm::ivec2 where{0};  ///< pixel in the middle of that tile
};

inline constexpr double kLeakRatio = 2;
inline constexpr double kLargestRatio = 1000;

/// What a leak map is made of. All of one size.
struct LeakInputs {
    const HdrImage& color;              ///< the picture to be judged, all light: how visible a difference is
    const HdrImage& indirect;           ///< its indirect light
    const HdrImage& referenceIndirect;  ///< the truth
    const HdrImage& standardError;      ///< of the truth, per pixel
    float exposure = 1;                 ///< at which the pictures are looked at
};
LeakMap findLeaks(const LeakInputs& inputs);

}  // namespace probegi::tool
