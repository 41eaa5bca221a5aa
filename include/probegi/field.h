#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "probegi/context.h"
#include "probegi/control.h"
#include "probegi/export.h"
#include "probegi/shared/field_data.h"
#include "probegi/snapshot.h"
#include "probegi/tracer.h"

namespace probegi {

/// The instructions that the hot loops of CPU fields run with on this processor, as Highway names them: SSE4, AVX2,
/// AVX3 (AVX-512), NEON... Chosen when the program runs.
PROBEGI_API std::string_view instructionSet() noexcept;

/// A datum in half the bytes, within 0.2 % (PackedRayDatum has the limits).
PROBEGI_API PackedRayDatum packRay(const RayDatum& datum) noexcept;

/// Wall-clock milliseconds of one update. Stages do not overlap; total includes what is in none of them.
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
    /// Estimate of how far the light of the worst region still is from its limit, relative, 0 or more; infinite
    /// where there were too few updates to tell.
    float remaining = 0;
};

/// Where Field::converge stands after an update, to go on from later, in another process too (probegi/field_file.h
/// keeps it). Empty: at the start.
struct ConvergeState {
    std::vector<std::uint32_t> words{};  ///< of the library's own

    bool empty() const noexcept { return words.empty(); }
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
    /// Errors: invalidArgument (the message names the member and its range), outOfMemory.
    static Result<Field> create(const Context& context, const FieldDesc& desc, const FieldSettings& settings = {});
    Field(Field&&) noexcept;
    Field& operator=(Field&&) noexcept;
    ~Field();

    /// Settings, events, the coming update's probes and rays.
    FieldControl& control() noexcept;
    const FieldControl& control() const noexcept;
    const FieldDesc& desc() const noexcept { return control().desc(); }
    FieldMemory memory() const noexcept;

    /// One update from the caller's own rays: datum [task * raysPerProbe + ray] came along
    /// control().rayDirections()[ray] from control().tasks()[task].origin. `fixedRays`, [task * fixedRays + ray] along
    /// fixedRayDirections(), lets the field react to changes at once and average noise over long windows; without it
    /// (empty) old light fades by the hysteresis. Errors: invalidArgument (wrong length), outOfMemory.
    Result<UpdateTimes> update(std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays = {});

    /// The same from packed data.
    Result<UpdateTimes> update(std::span<const PackedRayDatum> rayData, std::span<const FixedRayDatum> fixedRays = {});

    /// One update with the library's pipeline: trace, shade with `lighting` and last frame's field, blend. All surfaces
    /// reflect as Lambert of their base colour, at most 0.99 of it: a closed room of albedo 1 has no steady state.
    /// Errors: outOfMemory, and those of the tracer; the probes are then as they were.
    Result<UpdateTimes> update(const Tracer& tracer, const Lighting& lighting);

    /// For pictures of a scene that stands still: updates until the light of every region (a block of 4 x 4 x 4 probes,
    /// each relative to its own light) is estimated to be within `tolerance` of its limit, or maxFrames is reached.
    /// First the bounces, one an update, then an average in linear light, which is unbiased: what is estimated is the
    /// share of light that further bounces would add, and one and a half standard errors of the noise. The scene's and
    /// the grid's own errors are not in it. Not counted: probes in walls, and those with less than 1e-4 of the mean
    /// light; noise of those below 1e-2 counts as if they had that much. A last update lets update() go on from it.
    /// `tolerance` > 0, maxFrames >= 1; `onUpdate`, where given, receives the times of every update. The field's events
    /// and hysteresis are ignored. Errors: cancelled, invalidArgument, outOfMemory, and those of the tracer.
    Result<ConvergeResult> converge(const Tracer& tracer, const Lighting& lighting, float tolerance = 0.03f,
                                    int maxFrames = 256, const std::function<void(const UpdateTimes&)>& onUpdate = {});

    /// The same in several goes. `state`, empty at first, follows every update, before `onUpdate` is called; keep it
    /// with a snapshot of that moment. Once the snapshot is written back, converge() goes on from the state with the
    /// same arguments as if it had never stopped, to the bit; from that of one that came to its end, it returns at
    /// once. Errors: those above, and invalidArgument (a state of other probes, or not of this function).
    Result<ConvergeResult> converge(const Tracer& tracer, const Lighting& lighting, ConvergeState& state,
                                    float tolerance = 0.03f, int maxFrames = 256,
                                    const std::function<void(const UpdateTimes&)>& onUpdate = {});

    /// Moves the window of a volume by whole cells along the volume's axes, any number of them, so that it follows a
    /// camera (section 7.3; cellsToCentre() says how far). Probes that stay inside keep all they know. Those that enter
    /// take the slots of those that leave, and start empty: no look-up uses them before their first update, so update
    /// in the same frame (where all around a point is new, and no other volume knows the light, the answer is black
    /// until then). Excludes queries, as an update does. Errors: invalidArgument (no such volume; where coordinates are
    /// too coarse for its spacing, as create(); from converge()'s callback), outOfMemory; of a field on a GPU also
    /// deviceLost. The volume is then where it was.
    Result<void> scroll(int volume, glm::ivec3 cells);

    /// Scrolls all volumes with VolumeDesc::tracksCamera after a camera (cellsToFollow(): with a dead band), and tells
    /// look-ups where it is (FieldSettings::camera). Once a frame, before the update. Excludes queries, as scroll()
    /// does. Errors: those of scroll(), invalidArgument too where the position is not finite; volumes that were
    /// scrolled by then stay so, and look-ups know the camera where it was.
    Result<void> followCamera(glm::vec3 camera);

    /// Irradiance E in W m^-2. Unchecked and noexcept: vectors must be finite and unit (`toViewer`: or zero). Where
    /// volumes overlap they blend; one whose probes around the point are all new or in walls leaves the answer to
    /// others. Outside all of them the nearest one's nearest cell answers, or what FieldSettings::outside says. A field
    /// on a GPU that was lost returns NaN.
    glm::vec3 irradiance(const FieldQuery& query) const noexcept;

    /// The same for many points, on all threads.
    /// Errors: invalidArgument (the spans are not equally long); of a field on a GPU: deviceLost, outOfMemory.
    Result<void> irradiance(std::span<const FieldQuery> queries, std::span<glm::vec3> out) const;

    /// Queries so far, those of updates included, whose eight probes all stood in walls or did not see the point, so
    /// that wider neighbours answered: above a few per cent the grid is too coarse for the scene.
    std::uint64_t fallbackQueries() const noexcept;

    /// What the probes store, all of them or those of some slots. Errors: invalidArgument (slots that are not there),
    /// outOfMemory; of a field on a GPU also deviceLost.
    Result<FieldSnapshot> read() const;
    Result<FieldSnapshot> read(SlotRange slots) const;

    /// Replaces what the probes of the snapshot's slots store. A snapshot of all slots, from a field with an equal
    /// FieldDesc, resumes that field exactly: same place, same frame, same rays; pending events are discarded. After
    /// one of fewer, frame() is the later of both. Excludes queries, as an update does. Errors: invalidArgument (a
    /// snapshot of other volumes or maps, or of contents that no field stores), outOfMemory; of a field on a GPU also
    /// deviceLost. The probes are then as they were.
    Result<void> write(const FieldSnapshot& snapshot);

    struct Impl;

private:
    explicit Field(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Parameters of automatic placement.
struct PlacementDesc {
    glm::ivec3 counts{0};      ///< probes per axis; 0: from the scene's size
    int targetProbes = 8192;   ///< about how many where counts is 0, 8..2^24
    float marginCells = 1.0f;  ///< cells beyond the scene's bounds on every side, >= 0
    bool turned = true;        ///< placeVolume() by walls: the grid turns with a building that stands obliquely
};

/// A grid that covers the bounds with the asked-for margin and near-cubic cells.
/// Errors: invalidArgument (empty or non-finite bounds, counts out of range).
PROBEGI_API Result<VolumeDesc> placeVolume(const Bounds& bounds, const PlacementDesc& desc = {});

/// The same around everything that the tracer can hit, with an eye to what lies across the grid's axes: walls, floors
/// and ceilings, as rays from inside the scene find them. Light at a surface is best known where probes stand a fifth
/// of a cell in front of it, so along each axis the probes are moved by up to half a cell and drawn apart or together
/// by a few per cent; as many probes, and the margin holds. Axes along which there are no such surfaces (ground that
/// rolls) stay as above. Where many more surfaces stand by other axes than by the world's, the grid is turned to these
/// (`turned`), and covers what rays from outside find along them. Takes some 16,000 rays, and as many again where it is
/// turned; the same grid for the same scene. Errors: those above, and those of the tracer.
PROBEGI_API Result<VolumeDesc> placeVolume(const Tracer& tracer, const PlacementDesc& desc = {});

/// Nested volumes around a point, each coarser than the one inside it (section 7.4).
struct CascadeDesc {
    glm::vec3 centre{0.0f};         ///< of all of them, metres: where the camera is, say
    glm::vec3 spacing{0.5f};        ///< of the finest volume, metres, > 0
    glm::ivec3 counts{24, 12, 24};  ///< probes per axis of each, 5..1024
    int levels = 4;                 ///< 1..32; at most 2^24 probes in all of them
    float factor = 2.0f;            ///< spacing from level to level, > 1, at most 16
    bool tracksCamera = true;       ///< VolumeDesc::tracksCamera of all of them
};

/// The volumes for FieldDesc::volumes, the finest first. For what lies beyond the coarsest one, add a volume over the
/// level, or see FieldSettings::outside.
/// Errors: invalidArgument (the message names the member and its range).
PROBEGI_API Result<std::vector<VolumeDesc>> makeCascades(const CascadeDesc& desc);

}  // namespace probegi
