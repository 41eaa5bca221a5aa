#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string_view>

#include "probegi/context.h"
#include "probegi/export.h"
#include "probegi/grid.h"
#include "probegi/shared/field_data.h"
#include "probegi/tracer.h"

namespace probegi {

/// The second axis of the pipeline: which of the eight surrounding probes a point may use.
enum class LeakGuard : std::uint8_t {
    none,     ///< trilinear and backface weights only: the leaking baseline
    moments,  ///< DDGI: Chebyshev test on distance moments (section 2.2 and 4.1)
};

/// What an update ray that hits the back of a single-sided surface does to irradiance (section 4.1).
enum class BackfaceRule : std::uint8_t {
    zeroSample,  ///< counts as a sample of radiance 0 (the paper)
    excluded,    ///< is left out of the average
};

/// Which rules a field follows where measurements led away from the paper (docs/accuracy.md has the list).
enum class FieldRules : std::uint8_t {
    measured,  ///< what came out nearer to the path tracer
    paper,     ///< exactly what sections 2 and 4 of the paper say
};

/// How a Field is made. Distances are fractions of probe spacing: nothing here depends on the scene's scale.
struct FieldDesc {
    GridDesc grid{};
    int raysPerProbe = 144;     ///< update rays a probe and frame, 8..4096
    int fixedRays = 16;         ///< more rays a probe and update, always along the same directions: they tell change
                                ///< from noise (FieldRules::measured only); 0..256; 0: change is not looked for
    int irradianceTexels = 8;   ///< side of the octahedral irradiance map, 4..32, even
    int visibilityTexels = 16;  ///< side of the octahedral visibility map, 4..64, even
    float hysteresis = 0.97f;   ///< share of the old irradiance that survives an update (alpha of eq. 1), 0..0.999;
                                ///< with FieldRules::measured only after events, and where there are no fixed rays
    float visibilityHysteresis = 0.97f;  ///< the same for distance moments, on average over texels, 0..0.999
    float visibilityExponent = 200.0f;   ///< power of the cosine that weights distances, 1..500
    float selfShadowBias = 0.3f;         ///< TunableShadowBias of eq. 2, 0..2
    float significantChange = 0.25f;     ///< Listing 3, 0..1, change of the encoded texel over the larger; 0 disables
    float newDistribution = 0.8f;        ///< Listing 3, 0..1, same scale; 0 disables; both with FieldRules::paper only
    BackfaceRule backfaceRule = BackfaceRule::zeroSample;
    LeakGuard guard = LeakGuard::moments;
    FieldRules rules = FieldRules::measured;
    /// Points on emissive triangles that a probe looks at in each update besides its rays (Tracer::emitters), 0..16;
    /// 0: light of a lamp comes by rays that happen to meet it. FieldRules::paper: none, as in the paper.
    int emitterSamples = 4;
    std::uint64_t seed = 1;  ///< of the per-frame ray directions, the emitter samples and the storage dither
};

/// The instructions that the hot loops of CPU fields run with on this processor, as Highway names them: SSE4, AVX2,
/// AVX3 (AVX-512), NEON... Chosen when the program runs.
PROBEGI_API std::string_view instructionSet() noexcept;

/// Wall-clock milliseconds of one update. Stages overlap nothing; total includes what is in none of them.
struct UpdateTimes {
    double trace = 0;  ///< closest hits
    double shade = 0;  ///< surfaces, textures, shadow rays, multi-bounce query
    double blend = 0;  ///< matrix products, encoding, storage
    double total = 0;
};

/// How Field::converge ended.
struct ConvergeResult {
    int updates = 0;         ///< done
    bool converged = false;  ///< within the tolerance; else the cap on updates was hit first
    /// Estimate of how far the light of the worst region still is from where it goes, relative, 0 or more; infinite
    /// where there were too few updates to tell.
    float remaining = 0;
};

/// Changes that call for faster convergence than the plain hysteresis gives (section 4.3).
enum class FieldEvent : std::uint8_t {
    smallLightChange,   ///< irradiance hysteresis -15 % for 4 frames
    largeLightChange,   ///< irradiance hysteresis -50 % for 10 frames
    largeObjectChange,  ///< irradiance hysteresis -50 % for 10 frames, visibility hysteresis -50 % for 7 frames
};

/// Bytes that a field holds.
struct FieldMemory {
    std::size_t irradianceBytes = 0;
    std::size_t visibilityBytes = 0;
    std::size_t stateBytes = 0;
    std::size_t scratchBytes = 0;  ///< ray data and frame matrices; kept between updates
    std::size_t persistentBytes() const { return irradianceBytes + visibilityBytes + stateBytes; }
};

/// The probes' memory of what light and distance they see: irradiance and visibility, updated a little every frame and
/// queried anywhere. Move-only. Concurrent queries are safe; an update excludes queries.
class PROBEGI_API Field {
public:
    /// Errors: invalidArgument (the message names the field and its range), outOfMemory.
    static Result<Field> create(const Context& context, const FieldDesc& desc);
    Field(Field&&) noexcept;
    Field& operator=(Field&&) noexcept;
    ~Field();

    const FieldDesc& desc() const noexcept;
    int frame() const noexcept;  ///< updates so far
    FieldMemory memory() const noexcept;

    /// Unit directions of the coming update's rays, raysPerProbe of them, shared by all probes: a spherical Fibonacci
    /// set that every frame shifts, with FieldRules::paper turns at random (section 2.3).
    std::span<const glm::vec3> rayDirections() const noexcept;

    /// Unit directions of the fixed rays, the same for all updates and probes; desc().fixedRays of them, none with
    /// FieldRules::paper.
    std::span<const glm::vec3> fixedRayDirections() const noexcept;

    /// One update from the caller's own rays: datum [probe * raysPerProbe + ray] came along rayDirections()[ray] from
    /// probePosition(desc().grid, probe). `fixedRays`, [probe * fixedRays + ray] along fixedRayDirections(), lets the
    /// field follow changes at once and forget noise for long; without it (empty) old light fades by desc().hysteresis.
    /// Errors: invalidArgument (wrong length), outOfMemory.
    Result<UpdateTimes> update(std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays = {});

    /// One update with the library's pipeline: trace, shade with `lighting` and last frame's field, blend. All surfaces
    /// reflect as Lambert of their base colour, at most 0.99 of it: a closed room of albedo 1 has no steady state.
    /// Errors: outOfMemory, and those of the tracer; the probes are then as they were.
    Result<UpdateTimes> update(const Tracer& tracer, const Lighting& lighting);

    /// For pictures of a scene that stands still: updates until the light of every region (a block of 4 x 4 x 4 probes,
    /// each relative to its own light) is estimated to be within `tolerance` of where it goes, or maxFrames is reached.
    /// First the bounces, one an update, then an average in linear light, which is unbiased: what is estimated is the
    /// share of light that further bounces would add, and one and a half standard errors of the noise. The scene's and
    /// the grid's own errors are not in it. Not counted: probes in walls, and those with less than 1e-4 of the mean
    /// light; noise of those below 1e-2 counts as if they had that much.
    /// `tolerance` > 0, maxFrames >= 1; `onUpdate`, where given, receives the times of every update. The field's events
    /// and hysteresis take no part. Errors: cancelled, invalidArgument, outOfMemory, and those of the tracer.
    Result<ConvergeResult> converge(const Tracer& tracer, const Lighting& lighting, float tolerance = 0.03f,
                                    int maxFrames = 256, const std::function<void(const UpdateTimes&)>& onUpdate = {});

    /// Announces a change to the scene (section 4.3).
    void notify(FieldEvent event) noexcept;

    /// Changes the guard of later queries and updates; costs nothing, keeps all data.
    void setGuard(LeakGuard guard) noexcept;

    /// Irradiance E in W m^-2. Unchecked and noexcept: vectors must be finite and unit (`toViewer`: or zero). Outside
    /// the grid the nearest cell answers. A field on a GPU that was lost answers with not-a-number.
    glm::vec3 irradiance(const FieldQuery& query) const noexcept;

    /// The same for many points, on all threads.
    /// Errors: invalidArgument (the spans are not equally long); of a field on a GPU: deviceLost, outOfMemory.
    Result<void> irradiance(std::span<const FieldQuery> queries, std::span<glm::vec3> out) const;

    /// Queries so far, those of updates included, whose eight probes all stood in walls or did not see the point, so
    /// that wider neighbours answered: above a few per cent the grid is too coarse for the scene.
    std::uint64_t fallbackQueries() const noexcept;

    /// Share of probe `probe`'s hits that were on backs and speak for solid matter, 0..1; above 0.3 the probe stands in
    /// a wall and is not used. Backs of surfaces with two sides do not count while a free line leads from the probe, by
    /// way of its neighbours, to one that sees fronts.
    float probeBackfaceShare(int probe) const noexcept;

    /// What probe `probe` stores: E in W m^-2 for a surface facing `normal` at the probe itself.
    glm::vec3 probeIrradiance(int probe, glm::vec3 normal) const noexcept;
    /// Mean and mean square of the distance that probe `probe` stores in a direction, metres and square metres.
    glm::vec2 probeDistanceMoments(int probe, glm::vec3 direction) const noexcept;

    struct Impl;

private:
    explicit Field(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// How the automatic grid is laid.
struct PlacementDesc {
    glm::ivec3 counts{0};      ///< probes per axis; 0: from the scene's size
    int targetProbes = 8192;   ///< about how many where counts is 0, 8..2^24
    float marginCells = 1.0f;  ///< cells beyond the scene's bounds on every side, >= 0
};

/// A grid that covers the bounds with the asked-for margin and near-cubic cells.
/// Errors: invalidArgument (empty or non-finite bounds, counts out of range).
PROBEGI_API Result<GridDesc> placeGrid(const Bounds& bounds, const PlacementDesc& desc = {});

/// The same around everything that the tracer can hit, with an eye to what lies across the grid's axes: walls, floors
/// and ceilings, as rays from inside the scene find them. Light at a surface is best known where probes stand a fifth
/// of a cell in front of it, so along each axis the probes are moved by up to half a cell and drawn apart or together
/// by a few per cent; as many probes, and the margin holds. Axes along which there are no such surfaces (a scene that
/// is turned, ground that rolls) stay as above. Takes some 16,000 rays; the same grid for the same scene. Errors: those
/// above, and those of the tracer.
PROBEGI_API Result<GridDesc> placeGrid(const Tracer& tracer, const PlacementDesc& desc = {});

}  // namespace probegi
