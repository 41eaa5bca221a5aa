#pragma once

#include "reference/guide_lessons.h"

namespace probegi {

/// A guide for paths that start at the receivers. The field only provides the brightness of surfaces; whatever it
/// holds, the guide is a valid density. Errors: those of the field's query.
Result<PathGuide> learnGuide(const Context& context, const Transport& transport, const Field& field,
                             std::vector<GuideReceiver> first, std::uint64_t seed);

}  // namespace probegi
