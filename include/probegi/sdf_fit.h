#pragma once

#include <cstdint>
#include <span>

#include "probegi/context.h"
#include "probegi/export.h"
#include "probegi/sdf.h"
#include "probegi/tracer.h"

/// Primitives for a scene of triangles, found by themselves: what the authors of SDFDDGI placed by hand (section 3.1)
/// and left to future work (section 5).
namespace probegi {

/// How well primitives stand for a scene, by rays that start where cameras and probes can be: of random walks from the
/// scene's cameras and from points in the air all over it.
struct SdfAccuracy {
    std::int64_t rays = 0;  ///< by which it was measured; 0: nowhere in the scene is air
    double skyRays = 0;     ///< share of the rays that meet nothing in the scene, 0..1
    double toPrimitives =
        0;                  ///< mean distance of the scene's surface, where rays meet it, from the primitives', metres
    double toScene = 0;     ///< mean distance of the primitives' surface, where rays meet it, from the scene's, at most
                            ///< what rays along the normals and the way find, metres
    double leaking = 0;     ///< share of the rays that meet the scene but no primitive, 0..1
    double blockedSky = 0;  ///< share of those that meet nothing in the scene but a primitive, 0..1; 0: there are none
    double startInside = 0;  ///< share of the rays that start inside a primitive, 0..1
    // Dim places are those with less than half of the light of open ground, below an even sky: rooms and arcades, where
    // a closed window or a crack in a wall changes most of the light, and little of the figures above.
    double dimRays = 0;        ///< share of the rays that start at dim places, 0..1
    double dimSkyRays = 0;     ///< share of all rays that start there and meet nothing in the scene, 0..1
    double dimBlockedSky = 0;  ///< share of dimSkyRays that meet a primitive: sky lost there, 0..1; 0: there are none
    double dimLeaking = 0;     ///< those that start there and leak, over dimSkyRays: sky gained, 0..; 0: there are none
};

struct SdfFitDesc {
    int maxPrimitives = 64;  ///< 1..1024
    int rays = 400'000;      ///< of random walks, by which primitives are placed, 1,000..16,000,000
    /// Rounds in which some primitives are taken away and others put where most is wrong, 0..10,000. Time is in
    /// proportion.
    int rounds = 24;
    std::uint32_t seed = 1;
    /// Its pinned primitives are kept as they are, and count among maxPrimitives. Null: none. Read during the call
    /// only.
    const SdfScene* keep = nullptr;
};

struct SdfFit {
    SdfScene sdf;          ///< pinned primitives first, then those of the largest use; boxes, in the world
    SdfAccuracy accuracy;  ///< by other rays than those that placed them
};

/// Finds primitives for a scene as it stands in `pose`, which is that of `tracer`: boxes along the axes of most walls,
/// and along slopes that are common. Each has the colours (SdfPrimitive::faces) and the mean emission of what it stands
/// for, and is named after the material of most of it. Small things are left out where there are not enough primitives
/// for them; where less do, there are fewer. What moves is part of the fit, where it stands: give it pinned primitives
/// that ride on its nodes. The same for the same seed, whatever the number of threads. Errors: invalidArgument (the
/// message names the member and its range; a pinned primitive rides on a node that the scene lacks; the scene has no
/// air to look at it from), the tracer's, cancelled, outOfMemory.
PROBEGI_API Result<SdfFit> fitSdf(const Context& context, const Scene& scene, const ScenePose& pose,
                                  const Tracer& tracer, const SdfFitDesc& desc = {});

/// Measures primitives, of whatever origin, by `rays` rays, 1,000..16,000,000. Errors: as fitSdf().
PROBEGI_API Result<SdfAccuracy> measureSdf(const Context& context, const Scene& scene, const ScenePose& pose,
                                           const Tracer& tracer, const SdfScene& sdf, int rays = 200'000,
                                           std::uint32_t seed = 2);

}  // namespace probegi
