#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "probegi/export.h"
#include "probegi/field.h"
#include "probegi/reference.h"

/// Where a field leaks, found without a picture: points of surfaces whose light comes from probes that geometry hides
/// from them.
namespace probegi {

/// What a field's answer at one point owes to probes that do not see the point. A probe counts as hidden if geometry
/// blocks the straight line to the point itself and that to a place 0.15 spacings in front of it, so that relief finer
/// than the probes' spacing hides nothing.
struct LeakPoint {
    FieldQuery query;
    double area = 0;      ///< surface that it stands for, square metres; 0 from leaksAt()
    double hidden = 0;    ///< share of the look-up's weights that hidden probes have, 0..1
    double light = 0;     ///< what the field answers: E, mean of the channels, W m^-2
    double unleaked = 0;  ///< what it would answer from the probes that are not hidden; 0 where none is near, same unit
    /// Light that hidden probes bring or take, over the light of the brighter side of what hides them: above 0 light
    /// that leaks in (1 is all that is on the other side), below 0 a shadow that leaks out. 0 where both sides are lit
    /// alike, however large `hidden`.
    double leak = 0;
    int volume = -1;        ///< that answers
    int slot = -1;          ///< of the hidden probe with the largest weight; -1: none has any
    double slotShare = 0;   ///< its share of the weights
    glm::vec3 probe{0.0f};  ///< where it stands, metres
    bool probesSee = true;  ///< whether any probe of the cage sees the point
    bool gradient = false;  ///< most of the leak comes by the gradient along the normal, read between probes that do
                            ///< not see each other, and not by the weights
    double beyond = 0;      ///< how far outside all volumes the point lies, metres
    bool leaks() const { return leak != 0; }
};

/// Why a place leaks.
enum class LeakCause : std::uint8_t {
    guardOff,       ///< LeakGuard::none: nothing asks whether a probe sees the point
    beyondVolume,   ///< the place lies more than half a cell outside all volumes, whose nearest cell answers
    noProbeSees,    ///< none of the eight probes around the point sees it
    probeInMatter,  ///< the probe stands inside geometry, or behind what is modelled
    sheet,          ///< what hides the probe has no thickness: a single layer of triangles, or one seen from its back
    thinWall,       ///< a wall too thin for what the probes remember of distances at their spacing
    gradient,       ///< how light changes along the normal is read from probes on both sides of what hides them
    blurredEdge,    ///< the probe looks along an edge, where the distances that it remembers scatter
    sharedCluster,  ///< LeakGuard::masks: a cluster of probes, most of which the point sees, has the probe too
};

/// A place that leaks: leaking points beside each other, for one cause.
struct LeakPlace {
    LeakCause cause = LeakCause::thinWall;
    glm::vec3 position{0.0f};  ///< of its worst point, metres
    glm::vec3 normal{0.0f};    ///< of the surface there, unit
    glm::vec3 lower{0.0f};     ///< corners of the box around its points, metres
    glm::vec3 upper{0.0f};
    double area = 0;  ///< of surface, square metres
    int points = 0;

    double leak = 0;        ///< mean of LeakPoint::leak, by area: above 0 light, below 0 shadow
    double worst = 0;       ///< the one farthest from 0
    double light = 0;       ///< mean of LeakPoint::light by area, W m^-2
    double unleaked = 0;    ///< mean of LeakPoint::unleaked
    double truth = -1;      ///< what the path tracer finds at some of the points, mean, W m^-2; -1: it was not asked
    double truthError = 0;  ///< its standard error, W m^-2
    double harm = 0;  ///< how visible: area times the stops of exposure by which the light is wrong, square metres

    int volume = 0;           ///< that answers there
    glm::vec3 spacing{0.0f};  ///< of its probes, metres
    glm::vec3 probe{0.0f};    ///< the hidden probe with the largest weight at the worst point, metres
    double probeShare = 0;    ///< its share of the weights there, 0..1
    double wall = -1;         ///< thickness of what hides it, measured by rays across it, metres; 0: none; -1: unknown

    // What would help, each by itself; 0: would not, or does not apply.
    double thicken = 0;  ///< thickness that the wall needs, metres
    double refine = 0;   ///< largest distance between probes that would do, metres
    double move = 0;     ///< how far the probe is from the open, metres
    double extend = 0;   ///< how far the volume must reach out to hold the place, metres
};

struct AuditDesc {
    int points = 16384;   ///< of surfaces that are looked at, spread by area, 1..2^22
    double least = 0.01;  ///< leaks (LeakPoint::leak, either sign) below this are passed over, 0.0001..1
    /// Changes that nobody sees are passed over too: those below so many stops, on light to which 1 % of the mean is
    /// added. 0..10
    double leastStops = 0.15;
    std::uint64_t seed = 1;  ///< of the points
    /// Asked at each place whether the light there is in fact wrong; where it is right, in spite of what the weights
    /// say, the place is harmless. Null: the weights alone decide. Must outlive the call.
    const PathTracer* truth = nullptr;
    int truthSamples = 256;  ///< paths a point, 1..65536
};

struct LeakAudit {
    std::vector<LeakPlace> places;  ///< the most harmful first
    int points = 0;                 ///< looked at; fewer than asked for where most surfaces lie inside matter
    std::int64_t pairs = 0;         ///< of a point and a probe with weight there, all told
    std::int64_t hiddenPairs = 0;   ///< of which geometry hides the probe
    double area = 0;                ///< of all surfaces looked at, square metres
    double leakingArea = 0;         ///< of the places
    double hidden = 0;              ///< mean of LeakPoint::hidden over all points, by area
    double meanLight = 0;           ///< of LeakPoint::light, the same, W m^-2
    double worst = 0;               ///< largest LeakPlace::leak, 0..1; 0: nothing leaks. Shadows count alike
    int harmless = 0;               ///< places left out since the path tracer finds their light right
};

/// What the answers at some points owe to hidden probes. `tracer` may be another than the field's own: rays on the CPU,
/// say, and a field on a GPU. Errors: those of Field::read and of the tracer; cancelled, outOfMemory.
PROBEGI_API Result<std::vector<LeakPoint>> leaksAt(const Context& context, const Tracer& tracer, const Field& field,
                                                   std::span<const FieldQuery> points);

/// Looks for leaks all over a scene, and for each place that leaks says why and what would help. `field` should be
/// filled; one that is empty is black, and does not leak. The same for the same scene, field and seed, whatever the
/// number of threads. Errors: invalidArgument (the message names the member and its range; a field with
/// LeakGuard::sdfShadow, whose leaks have none of the causes), and those of leaksAt and of the path tracer.
PROBEGI_API Result<LeakAudit> auditLeaks(const Context& context, const Scene& scene, const ScenePose& pose,
                                         const Tracer& tracer, const Field& field, const AuditDesc& desc = {});

}  // namespace probegi
