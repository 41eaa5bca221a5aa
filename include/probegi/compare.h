#pragma once

#include "probegi/export.h"
#include "probegi/image.h"

namespace probegi {

/// Light of the test picture over that of the reference, as linear luminance. 1 is right.
struct LightRatio {
    double mean = 0;    ///< of the whole pictures
    double low = 0;     ///< 5th percentile over blocks of the picture: eight abreast, five one above the other
    double median = 0;  ///< 50th
    double high = 0;    ///< 95th
    int blocks = 0;     ///< behind the percentiles; blocks that are black in the reference are left out
};

/// Distances between a test picture and a reference picture.
struct ImageDifference {
    double rmse = 0;          ///< display-referred, 0..1, as the mask paper (section 4) defines it
    double relmse = 0;        ///< mean of (t - r)^2 / (r^2 + 0.01) over pixels and channels, linear
    double scaledRelmse = 0;  ///< the same with 0.01 m^2 for 0.01, m the reference's mean: no factor on both changes it
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

/// Colours 0..1 from dark to bright (perceptually ordered map), for error pictures. Display-referred sRGB in 0..1.
PROBEGI_API HdrImage heatmap(const HdrImage& values);

/// Display-referred sRGB values (what heatmap returns) as linear ones: what writeImage takes.
PROBEGI_API HdrImage linearFromDisplay(const HdrImage& display);

}  // namespace probegi
