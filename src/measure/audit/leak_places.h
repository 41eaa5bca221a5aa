#pragma once

#include <vector>

#include "measure/audit/leak_cause.h"

namespace probegi {

/// A leaking point and why.
struct ExplainedPoint {
    LeakPoint point;
    PointCause why;
};

/// Stops of exposure by which light is wrong, 0 or more: `meanLight` is the field's mean, a hundredth of which is added
/// to both, since darkness beside darkness is not seen.
double stopsApart(double light, double right, double meanLight);

/// Groups points that lie beside each other (nearer than a spacing, or than the points are apart on average), face
/// alike (but in nooks) and leak light alike (or shadow) for one cause. Groups of fewer than three points are chance,
/// and left out. In the order of their first points.
std::vector<std::vector<std::size_t>> groupPoints(const std::vector<ExplainedPoint>& points, const FieldRecord& record);

/// A place from its points; all but truth and harm.
LeakPlace placeOf(const std::vector<ExplainedPoint>& points, const std::vector<std::size_t>& group,
                  const FieldRecord& record);

}  // namespace probegi
