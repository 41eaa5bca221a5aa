#include "animation/frame_times.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

namespace probegi::tool {

namespace {

constexpr double kLargestTime = 1e6;  // as --time-of-scene
// A step that misses the end by this share of itself meets it: decimal steps add up inexactly.
constexpr double kRounding = 1e-6;

Error wrong(std::string_view text, std::string_view why) {
    return fail(ErrorCode::invalidArgument, fmt::format("'{}' {}", text, why));
}

}  // namespace

int FrameTimes::count() const {
    return int(std::floor((to - from) / step + kRounding)) + 1;
}

double FrameTimes::at(int frame) const {
    return std::min(from + frame * step, to);
}

Result<FrameTimes> parseFrameTimes(std::string_view text) {
    std::vector<double> values;
    bool good = true;
    for (std::size_t begin = 0; good && begin <= text.size();) {
        const std::size_t end = std::min(text.find(':', begin), text.size());
        double value = 0;
        const auto [read, code] = std::from_chars(text.data() + begin, text.data() + end, value);
        good = code == std::errc() && read == text.data() + end && std::abs(value) <= kLargestTime;
        values.push_back(value);
        begin = end + 1;
    }
    if (!good || values.size() != 3)
        return wrong(text, "is not A:B:STEP: three numbers of seconds, up to 1e6, e.g. 0:4:0.04");
    const FrameTimes times{values[0], values[1], values[2]};
    if (times.from > times.to) return wrong(text, "ends before it begins; A:B:STEP needs A <= B");
    if (!(times.step > 0)) return wrong(text, "has no step forward; STEP of A:B:STEP must be above 0");
    if (const double frames = std::floor((times.to - times.from) / times.step) + 1; frames > kMostFrames)
        return wrong(text,
                     fmt::format("asks for {:.6g} pictures; the limit is {}; use a larger STEP", frames, kMostFrames));
    return times;
}

}  // namespace probegi::tool
