#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace probegi {

/// Concatenates parts into a message; numbers have up to six digits, independent of the locale.
template <class... Parts>
std::string sentence(const Parts&... parts) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    (out << ... << parts);
    return std::move(out).str();
}

}  // namespace probegi
