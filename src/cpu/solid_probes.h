#pragma once

#include "cpu/field_view.h"

namespace probegi {

/// After a blend: finds the probes from which a free line leads into the open, so that the coming update knows which of
/// those that see backs stand in solid matter (kernels/probe/solid_probe.h). One step from probe to probe an update.
void findSolidProbes(const Context& context, const FieldView& view, std::span<const ProbeTask> tasks,
                     std::span<kernels::ProbeSides> sides);

}  // namespace probegi
