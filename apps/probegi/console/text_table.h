#pragma once

#include <string>
#include <vector>

namespace probegi::tool {

/// A Markdown table, aligned so that it is readable in a terminal too. The first row is the header; all rows have the
/// same number of cells.
std::string markdownTable(const std::vector<std::vector<std::string>>& cells);

/// The date as YYYY-MM-DD.
std::string today();

}  // namespace probegi::tool
