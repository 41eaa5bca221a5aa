#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "probegi/export.h"
#include "probegi/result.h"
#include "probegi/scene.h"
#include "probegi/shared/field_data.h"
#include "probegi/update_budget.h"
#include "probegi/volume.h"

namespace probegi {

class Masks;
class SdfBlockers;

/// The second axis of the pipeline: which of the eight surrounding probes a point may use.
enum class LeakGuard : std::uint8_t {
    none,       ///< trilinear and backface weights only: the leaking baseline
    moments,    ///< DDGI: Chebyshev test on distance moments (section 2.2 and 4.1)
    masks,      ///< visibility baked for the place itself (FieldSettings::masks), and moments where that sees no probe
    sdfShadow,  ///< SDFDDGI: soft shadows of primitives (FieldSettings::blockers), tested for each point and probe, and
                ///< moments where that sees no probe (section 3.4)
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

/// What a probe does (section 6, Figure 7).
enum class ProbeActivity : std::uint8_t {
    uninitialized,  ///< not placed yet: the coming update places it
    off,            ///< inside static geometry: never updated, never asked
    sleeping,       ///< no surface uses it: not updated, not asked
    newlyAwake,     ///< awake from its next update on, which keeps nothing of what it knew
    newlyVigilant,  ///< vigilant from its next update on
    awake,          ///< near something that moves, or in a medium
    vigilant,       ///< static surfaces use it: always updated
};

/// What light a point gets that no volume covers (FieldControl::coverage).
enum class OutsideLight : std::uint8_t {
    nearest,  ///< that of the nearest probes, however far they are
    fades,    ///< FieldSettings::outsideRadiance, by the share that is not covered
};

/// What a Field is made of; fixed once it is made.
struct FieldDesc {
    /// Its probes, 1..32 volumes. All have the same maps and share the rays of an update. Probes are numbered
    /// consecutively: slot 0 is the first probe of the first volume until that scrolls, the second volume follows the
    /// last probe of the first. Where volumes overlap, the one with most probes a cubic metre answers; over its last
    /// cell the next one takes over (section 7.4). Let volumes overlap by a cell: where they only touch, light may have
    /// a seam.
    std::vector<VolumeDesc> volumes = std::vector<VolumeDesc>(1);
    int raysPerProbe = 144;     ///< update rays per probe and frame, 8..4096
    int fixedRays = 16;         ///< more rays a probe and update, always along the same directions: they tell change
                                ///< from noise (FieldRules::measured only); 0..256; 0: change is not looked for
    int irradianceTexels = 8;   ///< side of the octahedral irradiance map, 4..32, even
    int visibilityTexels = 16;  ///< side of the octahedral visibility map, 4..64, even
    FieldRules rules = FieldRules::measured;
    /// Points on emissive triangles that a probe looks at in each update besides its rays (Tracer::emitters), 0..16;
    /// 0: light of a lamp comes by rays that happen to meet it. FieldRules::paper: none, as in the paper.
    int emitterSamples = 4;
    /// Probes leave walls, and keep a distance from surfaces, by up to 0.45 of the spacing along each axis (section 5).
    /// Done once for each probe, before its first update, by the static geometry: see FieldControl::setMoving. Traced
    /// updates place probes with rays of their own (six times 128 a probe); where the caller traces the rays, those of
    /// the first six updates do, and no look-up uses a probe before it is placed.
    bool relocation = false;
    /// Probes that no surface uses are not updated, and no look-up uses them (section 6): in open air, in solid walls,
    /// in the void. Things that move, and points in the air that are asked for, must be announced: see
    /// FieldControl::setMoving and setMedia.
    bool probeStates = false;
    std::uint64_t seed = 1;  ///< of the per-frame ray directions, the emitter samples and the storage dither
};

/// Probes of all volumes.
inline int probeCount(const FieldDesc& desc) {
    int sum = 0;
    for (const VolumeDesc& volume : desc.volumes) sum += probeCount(volume);
    return sum;
}

/// What may change from frame to frame. Distances are fractions of probe spacing: nothing here depends on the scene's
/// scale.
struct FieldSettings {
    float hysteresis = 0.97f;  ///< share of the old irradiance that survives an update (alpha of eq. 1), 0..0.999;
                               ///< with FieldRules::measured only after events, and where there are no fixed rays
    float visibilityHysteresis = 0.97f;  ///< the same for distance moments, on average over texels, 0..0.999
    float visibilityExponent = 200.0f;   ///< power of the cosine that weights distances, 1..500
    float selfShadowBias = 0.3f;         ///< TunableShadowBias of eq. 2, 0..2
    float significantChange = 0.25f;     ///< Listing 3, 0..1, change of the encoded texel over the larger; 0 disables
    float newDistribution = 0.8f;        ///< Listing 3, 0..1, same scale; 0 disables; both with FieldRules::paper only
    BackfaceRule backfaceRule = BackfaceRule::zeroSample;
    LeakGuard guard = LeakGuard::moments;
    /// For LeakGuard::masks, which needs them: bakeMasks() of these volumes. Such volumes cannot scroll.
    std::shared_ptr<const Masks> masks{};
    /// For LeakGuard::sdfShadow, which needs them: placeSdf().
    std::shared_ptr<const SdfBlockers> blockers{};
    /// Where the viewer stands, metres, in the world: volumes with VolumeDesc::tracksCamera answer around it. Empty:
    /// they answer as others do. Field::followCamera sets it.
    std::optional<glm::vec3> camera{};
    OutsideLight outside = OutsideLight::nearest;
    /// With OutsideLight::fades: the same from all sides, W sr^-1 m^-2, 0..1e20.
    glm::vec3 outsideRadiance{0.0f};

    bool operator==(const FieldSettings&) const = default;
};

/// Changes that call for faster convergence than the plain hysteresis gives (section 4.3).
enum class FieldEvent : std::uint8_t {
    smallLightChange,   ///< irradiance hysteresis -15 % for 4 frames
    largeLightChange,   ///< irradiance hysteresis -50 % for 10 frames
    largeObjectChange,  ///< irradiance hysteresis -50 % for 10 frames, visibility hysteresis -50 % for 7 frames
    /// Not in the paper, for things on their way: irradiance hysteresis -15 % for 4 frames, visibility hysteresis -50 %
    /// for 7 frames. With fixed rays, a larger reduction again and again is noise, not speed (docs/accuracy.md).
    smallObjectChange,
};

/// The state of a field from frame to frame, the same on every backend: what the coming update is about (probes, rays),
/// the settings, and the events that were announced. Every Field has one, and every vulkan::GpuField. Owned by the
/// field. Changes must not run concurrently with each other, an update, a query or converge() (its callback included).
class PROBEGI_API FieldControl {
public:
    const FieldDesc& desc() const noexcept;
    const FieldSettings& settings() const noexcept;
    int frame() const noexcept;  ///< updates so far

    /// New settings for all that follows, updates and look-ups; all data are kept.
    /// Errors: invalidArgument (the message names the setting and its range).
    Result<void> setSettings(const FieldSettings& settings);

    /// Where volume `volume` stands after all scrolling (Field::scroll): desc().volumes[volume] with another origin.
    VolumeDesc place(int volume) const noexcept;

    /// World bounds of all that moves, metres; they hold until they are replaced. Probes whose light they may ask for
    /// are awake (section 6.3), and placing probes ignores what is in them. Call it before the update when things have
    /// moved. Without FieldDesc::probeStates, only the placing of probes regards them. Errors: invalidArgument (bounds
    /// that are not finite, or upside down), outOfMemory.
    Result<void> setMoving(std::span<const Bounds> bounds);
    /// The same for points in the air that are asked for: fog, dust, particles. Probes in and around a medium stay
    /// awake.
    Result<void> setMedia(std::span<const Bounds> bounds);
    /// What the probe of a slot does, and where it stands: metres, in the world. Unchecked.
    ProbeActivity activity(int slot) const noexcept;
    glm::vec3 probePosition(int slot) const noexcept;
    /// How far the volumes, as they stand, cover a point of the world: 1 in a volume and up to half a cell beyond its
    /// outermost probes, then falling to 0 over one cell more; of several volumes the most. Of a volume that answers
    /// around the camera (VolumeDesc::tracksCamera) that box counts. Unchecked: the point must be finite.
    float coverage(glm::vec3 point) const noexcept;
    /// The same for many points. Errors: invalidArgument (the spans are not equally long).
    Result<void> coverage(std::span<const glm::vec3> points, std::span<float> out) const;
    /// The share of each volume in the answer at a point, in the order of desc().volumes; they sum to 1. Outside of all
    /// the nearest volume has it all. (Where a volume's probes are all new or in walls, others take over, which is not
    /// counted here.) Errors: outOfMemory.
    Result<std::vector<float>> volumeShares(glm::vec3 point) const;

    /// Announces a change to the scene (section 4.3). Durations count updates, whichever probes these update; with a
    /// budget each probe's own. The coming update's tasks change then.
    void notify(FieldEvent event) noexcept;
    /// The same for the probes inside a box, metres; an update treats all others as if nothing had been announced. Up
    /// to eight boxes act at a time; further ones are joined with those that grow least by it. A box that is inside
    /// out holds no probe; one with a NaN counts for all probes. findEdits() finds boxes.
    void notify(FieldEvent event, const Bounds& region) noexcept;

    /// The probes of the coming update, in the order of their ray data: those that are active. With relocation or
    /// states they change when probes are placed, fall asleep or wake, with a budget with every update, event, and
    /// change of the settings: ask before each update.
    std::span<const ProbeTask> tasks() const noexcept;
    /// Chooses the probes of all coming updates, by slot, in any order; empty: all of them, as at first. Others keep
    /// their contents; a probe that was never updated is black, and its first update replaces all of it. converge()
    /// always updates all that are active. Errors: invalidArgument (a slot that is not there, or twice), outOfMemory.
    Result<void> setTasks(std::span<const std::uint32_t> slots);

    /// Limits what the coming updates cost, which then have some of the tasks, in the same order. May be set before
    /// each update: with another limit, or as the view moves. UpdateBudget() ends it. converge() ignores it. Errors:
    /// invalidArgument (the message names the member and its range), outOfMemory.
    Result<void> setBudget(const UpdateBudget& budget);
    const UpdateBudget& budget() const noexcept;  ///< as it was set; none at first
    /// For UpdateBudget::milliseconds where Field::update does not measure by itself: what an update of so many probes
    /// took. It may come some updates late.
    void reportTime(double milliseconds, int probes) noexcept;
    /// How many updates of the field have passed without the probe of a slot: 0 after its own; of one that has had
    /// none, all since it entered its volume. Unchecked.
    int updateAge(int slot) const noexcept;

    /// Unit directions of the coming update's rays, raysPerProbe of them, shared by all probes: a spherical Fibonacci
    /// set that every frame shifts, with FieldRules::paper turns at random (section 2.3).
    std::span<const glm::vec3> rayDirections() const noexcept;
    /// Unit directions of the fixed rays, the same for all updates and probes; desc().fixedRays of them, none with
    /// FieldRules::paper.
    std::span<const glm::vec3> fixedRayDirections() const noexcept;

    FieldControl(const FieldControl&) = delete;
    FieldControl& operator=(const FieldControl&) = delete;
    ~FieldControl();

    struct Impl;
    explicit FieldControl(std::unique_ptr<Impl> impl);
    Impl& impl() noexcept { return *m_impl; }
    const Impl& impl() const noexcept { return *m_impl; }

private:
    std::unique_ptr<Impl> m_impl;
};

}  // namespace probegi
