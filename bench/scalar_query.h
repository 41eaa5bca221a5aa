#pragma once

#include "cpu/field_view.h"

namespace probegi::bench {

/// The look-up in a field's first volume, one point and one probe at a time. Benchmarks compare the SIMD look-up of
/// src/cpu/query_lanes.cpp with it in speed, tests in results.
void queryScalar(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out);

}  // namespace probegi::bench
