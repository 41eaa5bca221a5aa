#pragma once

#include "probegi/audit.h"
#include "probegi/image.h"

namespace probegi::tool {

/// What a camera sees, pixel by pixel: the leaks there (LeakPoint::leak), 0 where it sees the sky or nothing leaks.
struct SeenLeaks {
    std::vector<LeakPoint> points;    ///< of the pixels that show a surface
    std::vector<std::size_t> pixels;  ///< their places in the picture, row by row
};

/// Rays on `tracer`, one a pixel. Errors: those of leaksAt and of the tracer.
Result<SeenLeaks> leaksSeen(const Context& context, const Tracer& tracer, const Field& field,
                            const PlacedCamera& camera, int width, int height);

/// The picture dimmed to grey, with light that leaks in in red and shadow that leaks out in blue, the stronger the more
/// visible; what `desc` passes over stays grey. The values are for writeImage at exposure 1.
HdrImage drawLeaks(const HdrImage& color, float exposure, const SeenLeaks& seen, const AuditDesc& desc);

}  // namespace probegi::tool
