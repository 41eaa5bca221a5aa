#pragma once

#include <string>
#include <string_view>

#include "probegi/result.h"

namespace probegi::tool {

/// The file names of an animation's pictures: "frame%04d.png" has four digits at least. "%%" is a percent sign.
class FramePattern {
public:
    /// Errors: invalidArgument: not exactly one %d, anything else after a %, a folder with a number.
    static Result<FramePattern> parse(std::string_view text);

    std::string name(int frame) const;

private:
    std::string m_before, m_after;
    int m_digits = 0;
};

}  // namespace probegi::tool
