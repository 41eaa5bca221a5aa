#pragma once

#include <string_view>

namespace probegi::tool {

/// What the report page carries inside: its style sheet and its script.
extern const std::string_view kReportStyle;
extern const std::string_view kReportScript;

}  // namespace probegi::tool
