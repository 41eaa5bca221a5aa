#pragma once

#include "cpu/probe_query.h"

namespace probegi::bench {

/// The query with the moments guard from the same kernels, one probe after the other instead of eight abreast: what the
/// SIMD of src/cpu/probe_query.cpp is compared with. Points that no probe can answer get whatever comes out.
void queryScalar(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out);

}  // namespace probegi::bench
