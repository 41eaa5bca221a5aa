#pragma once

#include "cpu/probe_query.h"

namespace probegi::bench {

/// The look-up in a field's first volume, one point and one probe after the other: what the SIMD of
/// src/cpu/query_lanes.cpp is compared with, in speed and in the tests in what it answers.
void queryScalar(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out);

}  // namespace probegi::bench
