#include "console/text_table.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

namespace probegi::tool {

std::string markdownTable(const std::vector<std::vector<std::string>>& cells) {
    std::vector<std::size_t> widths(cells.front().size(), 3);
    for (const auto& row : cells)
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    std::string text;
    for (std::size_t r = 0; r < cells.size(); ++r) {
        for (std::size_t c = 0; c < widths.size(); ++c) text += fmt::format("| {:<{}} ", cells[r][c], widths[c]);
        text += "|\n";
        if (r > 0) continue;
        for (const std::size_t width : widths) text += fmt::format("|{:-<{}}", "", width + 2);
        text += "|\n";
    }
    return text;
}

std::string today() {
    return fmt::format("{:%Y-%m-%d}", fmt::localtime(std::time(nullptr)));
}

}  // namespace probegi::tool
