#pragma once

#include <span>
#include <vector>

#include "measure/audit/field_record.h"
#include "probegi/audit.h"
#include "probegi/tracer.h"

namespace probegi {

/// How far in front of a surface a probe may be seen from and still count as seen, in spacings.
inline constexpr float kLean = 0.15f;

/// The slots among a point's probes that geometry hides, with the pairs whose two probes do not see each other.
struct Hidden {
    LeftOut out;                   ///< slots: of the cage, and of its neighbours where those were asked
    std::array<bool, 8> corner{};  ///< of the cage
};

/// Points and probes with weight there, and those of them that do not see each other.
struct LeakCounts {
    std::int64_t pairs = 0, hiddenPairs = 0;
};

/// leaksAt() for points of one task; `counts` are added to. Errors: those of the tracer.
Result<void> measureLeaks(const FieldRecord& record, const Tracer& tracer, std::span<const FieldQuery> queries,
                          std::span<LeakPoint> out, LeakCounts& counts);

/// The same for many points, on all threads, with progress. Errors: the same, and cancelled.
Result<std::vector<LeakPoint>> measureAllLeaks(const Context& context, const FieldRecord& record, const Tracer& tracer,
                                               std::span<const FieldQuery> queries, LeakCounts& counts);

/// What is hidden from each point, by the point's look-up. Errors: those of the tracer.
Result<std::vector<Hidden>> hiddenAt(const FieldRecord& record, const Tracer& tracer,
                                     std::span<const FieldQuery> queries, std::span<const LookUp> looks);

}  // namespace probegi
