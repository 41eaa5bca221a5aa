#pragma once

#include <string>
#include <vector>

namespace probegi::tool {

/// A table in Markdown, aligned so that it can be read in a terminal too. The first row is the header and is as long as
/// any other.
std::string markdownTable(const std::vector<std::vector<std::string>>& cells);

/// As YYYY-MM-DD.
std::string today();

}  // namespace probegi::tool
