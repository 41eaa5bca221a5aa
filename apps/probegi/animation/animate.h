#pragma once

#include "render_options.h"

namespace probegi::tool {

/// `probegi render --animate`: a picture for each of its moments, in files by the pattern of -o, or a video. Errors: of
/// the options, the scene, the backend, the files. Pictures that were written before an error stay.
Result<void> renderAnimation(const RenderOptions& options);

}  // namespace probegi::tool
