#pragma once

#include <span>
#include <vector>

#include "probegi/reference.h"
#include "reference/transport.h"

namespace probegi {

/// PathTracer::irradiance with all settings of the transport. Errors: cancelled, and those of the
/// tracer.
Result<std::vector<ReferenceIrradiance>> estimateIrradiance(const Context& context, const Transport& transport,
                                                            const PathSettings& settings,
                                                            std::span<const FieldQuery> points, int samples,
                                                            std::uint64_t seed);

}  // namespace probegi
