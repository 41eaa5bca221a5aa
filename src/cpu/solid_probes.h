#pragma once

#include "cpu/probe_query.h"

namespace probegi {

/// After a blend: finds the probes with a clear path into the open, so that the next update knows which of those that
/// see backs are in solid matter (kernels/probe/solid_probe.h). Paths grow by one probe per update.
void findSolidProbes(const Context& context, const FieldView& view, std::span<kernels::ProbeSides> sides);

}  // namespace probegi
