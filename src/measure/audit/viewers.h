#pragma once

#include <cstdint>
#include <span>

#include "probegi/shared/field_data.h"
#include "probegi/tracer.h"

namespace probegi {

/// Lets each point be looked at from where there is room: of four random directions (by the cosine,
/// FieldQuery::toViewer the first of them) the one with the longest free way. Look-ups are moved towards the viewer,
/// and no camera stands in the wall beside a corner. Errors: those of the tracer.
Result<void> placeViewers(const Tracer& tracer, std::span<FieldQuery> points, std::uint64_t seed);

}  // namespace probegi
