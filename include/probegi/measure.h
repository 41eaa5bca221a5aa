#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "probegi/audit.h"
#include "probegi/export.h"
#include "probegi/field.h"
#include "probegi/image.h"
#include "probegi/reference.h"

/// How far pictures and fields are from the truth: what the tool, its report and docs/accuracy.md say in numbers, and
/// what tests hold against their bounds. Luminance is Rec.709's; a point's light, where nothing else is said, is the
/// mean of the three channels of E in W m^-2.
namespace probegi {

// ---- Numbers

struct Percentiles {
    double low = 0;     ///< 5th
    double median = 0;  ///< 50th
    double high = 0;    ///< 95th
};

/// Linear between neighbours; all 0 for an empty list. The values must be finite.
PROBEGI_API Percentiles percentiles(std::vector<double> values);

// ---- Pictures

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

/// Errors: invalidArgument (sizes differ, or a value is not finite), outOfMemory.
PROBEGI_API Result<Comparison> compareImages(const HdrImage& test, const HdrImage& reference,
                                             const ToneMap& toneMap = {});

/// What an exact picture would score against this reference, for the reference's own noise: the reference against
/// itself with as much noise again as `standardError` (per pixel, same unit) says it has. The same for the same seed
/// and the same standard library. Errors: those of compareImages.
PROBEGI_API Result<Comparison> noiseFloor(const HdrImage& reference, const HdrImage& standardError, std::uint64_t seed,
                                          const ToneMap& toneMap = {});

/// Mean standard error over mean value, over all pixels and channels; 0 of a black picture.
/// Errors: invalidArgument (sizes differ, or a value is not finite).
PROBEGI_API Result<double> relativeNoise(const HdrImage& picture, const HdrImage& standardError);

/// Colours 0..1 from dark to bright (perceptually ordered map), for error pictures. Display-referred sRGB in 0..1.
PROBEGI_API HdrImage heatmap(const HdrImage& values);

/// Display-referred sRGB values (what heatmap returns) as linear ones: what writeImage takes.
PROBEGI_API HdrImage linearFromDisplay(const HdrImage& display);

inline constexpr double kLeakRatio = 2;        ///< light over the truth from which a place leaks
inline constexpr double kLargestRatio = 1000;  ///< to which ratios are cut

/// What a leak map is made of: pictures of one size, which must outlive the call.
struct LeakInputs {
    const HdrImage& color;              ///< the picture to be judged, all light: how visible a difference is
    const HdrImage& indirect;           ///< its indirect light
    const HdrImage& referenceIndirect;  ///< the truth
    const HdrImage& standardError;      ///< of the truth, per pixel
    float exposure = 1;                 ///< at which the pictures are looked at, > 0
};

/// Where a picture's indirect light is not the reference's, in square tiles that are wide enough for the reference's
/// noise to average out. It cannot tell why there is too much light: it may have come through a wall, or a shadow is
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

/// Errors: invalidArgument (sizes differ, a value is not finite, exposure out of range), outOfMemory.
PROBEGI_API Result<LeakMap> findLeaks(const LeakInputs& inputs);

// ---- A field at points

/// A grid of `perSide` x `perSide` points on each of the six inner faces of a box, seen from its middle.
PROBEGI_API std::vector<FieldQuery> wallPoints(const Bounds& room, int perSide);

/// What random rays from random places in `bounds` meet from the front: at most `count` (up to 2^24) points that
/// somebody in the scene can see, each looked at along its ray; the same for the same scene and the same standard
/// library. Errors: outOfMemory, and those of the tracer.
PROBEGI_API Result<std::vector<FieldQuery>> visiblePoints(const Tracer& tracer, const Bounds& bounds, int count);

/// Random points of all surfaces by area, on the side that lies in the open, each looked at from a random direction
/// (cosine-distributed): `count` of them, the same for the same scene; fewer where most of it lies inside matter.
/// Errors: outOfMemory, and those of the tracer.
PROBEGI_API Result<std::vector<FieldQuery>> surfacePoints(const Scene& scene, const ScenePose& pose,
                                                          const Tracer& tracer, int count);

/// The field's light at each point. Errors: outOfMemory, and those of Field::irradiance.
PROBEGI_API Result<std::vector<double>> lightAt(const Field& field, std::span<const FieldQuery> points);

/// Mean of that; 0 of no points. Errors: the same.
PROBEGI_API Result<double> meanLight(const Field& field, std::span<const FieldQuery> points);

/// Leak energy: mean light at points that in truth are black (on the walls of a sealed room) over the mean at points
/// beside them that are lit. 0 is right; infinite where the lit points are black. Errors: those of meanLight.
PROBEGI_API Result<double> leakShare(const Field& field, std::span<const FieldQuery> sealed,
                                     std::span<const FieldQuery> lit);

/// Light at some points against other light at the same points.
struct LightDifference {
    double mean = 0;  ///< mean over the reference's mean: 1 is right
    double rms = 0;   ///< root of the mean squared difference over the reference's mean, 0 or more
};

/// Both 0 where the reference is black. Errors: invalidArgument (not equally many values).
PROBEGI_API Result<LightDifference> compareLight(std::span<const double> light, std::span<const double> reference);

/// Points with what the path tracer finds there.
struct SurfaceTruth {
    std::vector<FieldQuery> queries;
    std::vector<double> truth;          ///< luminance of E, W m^-2
    std::vector<double> standardError;  ///< of truth, same unit
};

/// `samples` paths a point. Errors: outOfMemory, and those of PathTracer::irradiance.
PROBEGI_API Result<SurfaceTruth> traceSurfaceTruth(const PathTracer& pathTracer, std::vector<FieldQuery> points,
                                                   int samples);

/// How a field answers there. Places with less than a hundredth of the mean light (the outside of a hull, the inside of
/// a crown of leaves) are left out. The first two weigh every point by its light, so that dark corners, whose ratios
/// mean little, do not decide.
struct SurfaceError {
    double mean = 0;    ///< sum of the field's E over sum of the truth's: 1 is right
    double rms = 0;     ///< root of the mean squared difference over the mean truth; the truth's noise is taken out
    double low = 0;     ///< 5th percentile of the ratios at points with more than a tenth of the mean light
    double median = 0;  ///< 50th percentile
    double high = 0;    ///< 95th percentile
    std::size_t points = 0;  ///< compared
};

/// `luminance`: of E, in the order of the points. Errors: invalidArgument (not equally many values), outOfMemory.
PROBEGI_API Result<SurfaceError> compareAtSurfaces(std::span<const double> luminance, const SurfaceTruth& truth);

/// Errors: outOfMemory, and those of Field::irradiance.
PROBEGI_API Result<SurfaceError> compareAtSurfaces(const Field& field, const SurfaceTruth& truth);

// ---- A field at its probes

/// The truth at a spread of a grid's probes: E summed over the six axis directions, as luminance.
struct ProbeTruth {
    struct Probe {
        int index = 0;
        double irradiance = 0;     ///< W m^-2
        double standardError = 0;  ///< same unit
    };
    std::vector<Probe> probes;  ///< those that count
    int inWalls = 0;            ///< left out: more than a quarter of what they see are backs of walls
    int dark = 0;               ///< left out: too little light, or too noisy a truth, for a ratio to mean anything
    double noise = 0;           ///< median of standardError / irradiance over the probes that count
};

/// Path traces at up to `maxProbes` probes in free space, `samples` paths a direction. Errors: outOfMemory, and those
/// of both tracers.
PROBEGI_API Result<ProbeTruth> traceProbeTruth(const Tracer& tracer, const PathTracer& pathTracer,
                                               const VolumeDesc& grid, int maxProbes, int samples, bool diffuseOnly);

/// Field over truth, probe by probe; the truth's grid must be the field's first volume as it stands. 1 is right.
PROBEGI_API std::vector<double> probeRatios(const FieldSnapshot& snapshot, const ProbeTruth& truth);

/// Light of one field's probes against that of another's with the same probes. A probe's light is the mean over all
/// directions and channels of E; probes that either field does not use are left out.
struct FieldDifference {
    double mean = 0;           ///< light of all probes together, A over B: 1 is alike; 0 where B is black
    double rms = 0;            ///< root of the mean squared difference of E over directions and channels, over B's mean
    Percentiles ratio;         ///< of a probe's light, A over B, where B has a hundredth of its mean or more
    double worst = 0;          ///< of those: the largest difference of a probe's light, over its light in B
    int worstSlot = -1;        ///< of that probe; -1: there is none
    int probes = 0;            ///< compared
    bool equalMaps = false;    ///< irradiance and distances are the same, to the bit
    bool equalStates = false;  ///< and what probes keep besides
};

/// Errors: invalidArgument (the snapshots are of other volumes or maps, of some probes only, or invalid), outOfMemory.
PROBEGI_API Result<FieldDifference> compareFields(const FieldSnapshot& a, const FieldSnapshot& b);

// ---- A field in motion

/// How unsteady light is where nothing changes: temporal standard deviation over mean, point by point. Points with less
/// than a hundredth of the mean light are left out.
struct Flicker {
    double mean = 0;  ///< over the points
    double high = 0;  ///< 95th percentile
};

/// `updates`: what lightAt() gave after each. Errors: invalidArgument (not equally many values), outOfMemory.
PROBEGI_API Result<Flicker> measureFlicker(std::span<const std::vector<double>> updates);

/// How much of the way from `start` to `goal` is left: 1 at the start, 0 at the goal, negative beyond it. Every point
/// counts by its own light, those with less than a hundredth of the mean as if they had that much. 0 where start and
/// goal are the same. Errors: invalidArgument (not equally many values).
PROBEGI_API Result<double> shareLeft(std::span<const double> now, std::span<const double> start,
                                     std::span<const double> goal);

}  // namespace probegi
