#include "animation/frame_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace probegi::tool {

namespace {

constexpr int kMostDigits = 9;

/// A conversion such as "04d", after its percent sign.
struct Conversion {
    int digits = 0;
    std::size_t length = 0;
};

std::optional<Conversion> conversionAt(std::string_view text) {
    Conversion c;
    if (!text.empty() && text[0] == '0') c.length = 1;
    const bool padded = c.length == 1;
    while (c.length < text.size() && std::isdigit(static_cast<unsigned char>(text[c.length]))) {
        c.digits = 10 * c.digits + (text[c.length++] - '0');
        if (c.digits > kMostDigits) return {};
    }
    // Padding with spaces, "%4d", would put them into file names.
    if (c.length >= text.size() || text[c.length] != 'd' || (c.digits > 0 && !padded)) return {};
    ++c.length;
    return c;
}

Error wrong(std::string_view text, std::string_view why) {
    return fail(
        ErrorCode::invalidArgument,
        fmt::format("-o '{}' {}; --animate needs one number of the picture in it, e.g. frame%04d.png", text, why));
}

}  // namespace

Result<FramePattern> FramePattern::parse(std::string_view text) {
    FramePattern pattern;
    int conversions = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string& part = conversions > 0 ? pattern.m_after : pattern.m_before;
        if (text[i] != '%') {
            part += text[i];
            continue;
        }
        if (text.substr(i + 1).starts_with('%')) {
            part += '%';
            ++i;
            continue;
        }
        const auto conversion = conversionAt(text.substr(i + 1));
        if (!conversion) return wrong(text, "has a % that begins neither %d, %0Nd with N up to 9, nor %%");
        if (++conversions > 1) return wrong(text, "has more than one number");
        pattern.m_digits = conversion->digits;
        i += conversion->length;
    }
    if (conversions == 0) return wrong(text, "has no number, so all pictures would be one file");
    if (pattern.m_after.find('/') != std::string::npos) return wrong(text, "has its number in the name of a folder");
    return pattern;
}

std::string FramePattern::name(int frame) const {
    return fmt::format("{}{:0{}}{}", m_before, frame, std::max(m_digits, 1), m_after);
}

}  // namespace probegi::tool
