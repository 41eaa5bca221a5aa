#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace probegi {

/// All parts one after the other, for messages: numbers have up to six digits and no language.
template <class... Parts>
std::string sentence(const Parts&... parts) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    (out << ... << parts);
    return std::move(out).str();
}

}  // namespace probegi
