#pragma once

#include <string_view>

namespace probegi::tool {

/// Style sheet and script, embedded in the report page.
extern const std::string_view kReportStyle;
extern const std::string_view kReportScript;

}  // namespace probegi::tool
