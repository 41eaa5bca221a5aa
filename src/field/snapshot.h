#pragma once

#include "field/layout.h"
#include "kernels/blend/temporal_filter.h"
#include "kernels/probe/solid_probe.h"
#include "probegi/snapshot.h"

namespace probegi {

/// A snapshot of black probes that nothing is known of.
FieldSnapshot emptySnapshot(const FieldDesc& desc, SlotRange slots);

/// Errors: invalidArgument (slots that a field of this desc does not have).
Result<void> validateSlots(const FieldDesc& desc, SlotRange slots);
/// Whether a field of this desc can be written with it. Errors: invalidArgument (another field's volumes or maps,
/// arrays of a wrong length, values that no update stores).
Result<void> validateSnapshot(const FieldDesc& desc, const FieldSnapshot& snapshot);

ProbeState probeState(float backfaceShare, const kernels::ProbeSides& sides, const kernels::PackedProbeFilter& filter);
kernels::ProbeSides sidesOf(const ProbeState& state) noexcept;
kernels::PackedProbeFilter filterOf(const ProbeState& state) noexcept;

}  // namespace probegi
