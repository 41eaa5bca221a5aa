#pragma once

#include <optional>

#include "measure/audit/leak_points.h"

namespace probegi {

/// What lies between a point and a probe, found by a ray.
struct Obstacle {
    bool any = false;
    /// Thickness of the first thing in the way, across it, metres; 0: it has none (one layer of triangles, or one that
    /// the ray meets from its back).
    double thickness = 0;
    double cosine = 1;         ///< between the ray and the normal of that thing, 0..1
    bool aroundProbe = false;  ///< it ends only behind the probe, which stands inside
};

/// Errors: those of the tracer.
Result<Obstacle> obstacleBetween(const Tracer& tracer, const FieldQuery& point, glm::vec3 probe);

/// How much thicker the walls around a point would have to be, across them, metres, until its hidden probes have no
/// more than `least` of the weights by LeakGuard::moments. The probes stay as they are: their distances to the walls'
/// far sides do not change, the point moves away from them. Nothing: not within `most` metres. `cosine`:
/// Obstacle::cosine.
std::optional<double> missingThickness(const FieldRecord& record, const FieldQuery& point, const Hidden& hidden,
                                       double cosine, double least, double most);

/// The largest spacing, metres, at which some probe of a lattice is sure to stand in the free space around a point:
/// that of the field there, shrunk by what is free along the axis where there is least. Errors: those of the tracer.
Result<double> spacingThatSees(const FieldRecord& record, const Tracer& tracer, const FieldQuery& point);

/// How far a probe in matter is from the nearest surface that it sees from the back, metres; 0: it sees none.
/// Errors: those of the tracer.
Result<double> distanceToOpen(const Tracer& tracer, glm::vec3 probe);

/// Whether a point lies inside closed matter, where no camera gets: on the way out, in all of some directions, it
/// leaves more things than it enters. Errors: those of the tracer.
Result<bool> isInsideMatter(const Tracer& tracer, const FieldQuery& point);

/// Why one point leaks, and what would help: the members of LeakPlace from `cause` on that follow from one point.
/// Errors: those of the tracer.
struct PointCause {
    LeakCause cause = LeakCause::thinWall;
    double wall = -1, thicken = 0, refine = 0, move = 0, extend = 0;
};
Result<PointCause> explain(const FieldRecord& record, const Tracer& tracer, const LeakPoint& point, double least);

}  // namespace probegi
