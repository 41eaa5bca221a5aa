#pragma once

#include "probegi/export.h"
#include "probegi/image.h"

namespace probegi {

/// Ratio of linear luminance, test picture over reference; 1 is a perfect match.
struct LightRatio {
    double mean = 0;    ///< over the whole picture
    double low = 0;     ///< 5th percentile over a grid of blocks, eight wide and five high
    double median = 0;  ///< 50th
    double high = 0;    ///< 95th
    int blocks = 0;     ///< number of blocks behind the percentiles; those that are black in the reference are left out
};

/// Error metrics of a test picture against a reference.
struct ImageDifference {
    double rmse = 0;          ///< display-referred, 0..1, as the mask paper (section 4) defines it
    double relmse = 0;        ///< mean of (t - r)^2 / (r^2 + 0.01) over pixels and channels, linear
    double scaledRelmse = 0;  ///< the same with 0.01 m^2 for 0.01, m the reference's mean: invariant to a common scale
    double flip = 0;          ///< mean LDR-FLIP (Andersson et al. 2020) at 67 pixels per degree, 0..1
    LightRatio ratio;         ///< all 0 where the reference is black
};

struct Comparison {
    ImageDifference difference;
    HdrImage flipMap;  ///< per-pixel FLIP in all three channels, 0..1
    HdrImage rmseMap;  ///< per-pixel display-referred error in all three channels, 0..1
};

/// Errors: invalidArgument (sizes differ, or a value is not finite).
PROBEGI_API Result<Comparison> compareImages(const HdrImage& test, const HdrImage& reference,
                                             const ToneMap& toneMap = {});

/// Maps 0..1 to a perceptually ordered colour map, for error pictures. Returns display-referred sRGB in 0..1.
PROBEGI_API HdrImage heatmap(const HdrImage& values);

/// Converts display-referred sRGB (what heatmap returns) to linear values (what writeImage takes).
PROBEGI_API HdrImage linearFromDisplay(const HdrImage& display);

}  // namespace probegi
