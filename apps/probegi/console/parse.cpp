#include "console/parse.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <system_error>

namespace probegi::tool {

namespace {

constexpr int kMaxSide = 16384;
constexpr float kMaxMagnitude = 1e12f;  // so that products of two are finite

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string_view::npos) return parts;
        begin = end + 1;
    }
}

template <class T>
bool parseWhole(std::string_view text, T& value) {
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc() && end == text.data() + text.size();
}

Error expected(std::string_view text, std::string_view what) {
    return fail(ErrorCode::invalidArgument, fmt::format("'{}' is not {}", text, what));
}

bool nonNegative(glm::vec3 v) {
    return v.x >= 0 && v.y >= 0 && v.z >= 0;
}

}  // namespace

Result<std::vector<float>> parseNumbers(std::string_view text, std::size_t count) {
    const auto parts = split(text, ',');
    std::vector<float> values(parts.size());
    bool good = parts.size() == count;
    for (std::size_t i = 0; good && i < parts.size(); ++i)
        good = parseWhole(parts[i], values[i]) && std::abs(values[i]) <= kMaxMagnitude;
    if (!good)
        return expected(text, count == 1 ? std::string("a finite number up to 1e12")
                                         : fmt::format("{} finite numbers up to 1e12 with commas between them", count));
    return values;
}

Result<glm::vec3> parseVector(std::string_view text) {
    const auto values = parseNumbers(text, 3);
    if (!values) return values.error();
    return glm::vec3((*values)[0], (*values)[1], (*values)[2]);
}

Result<glm::ivec3> parseCounts(std::string_view text) {
    const auto parts = split(text, 'x');
    glm::ivec3 counts(0);
    bool good = parts.size() == 3;
    for (int axis = 0; good && axis < 3; ++axis)
        good = parseWhole(parts[std::size_t(axis)], counts[axis]) && counts[axis] >= 2 && counts[axis] <= 1024;
    if (!good || std::int64_t(counts.x) * counts.y * counts.z > (1 << 24))
        return expected(text, "XxYxZ with 2 to 1024 probes per axis and at most 16777216 in all, e.g. 16x8x16");
    return counts;
}

Result<VolumeDesc> parseVolume(std::string_view text) {
    constexpr std::string_view kForm = "ORIGIN:SPACING:COUNTS, e.g. -4,0,-4:0.5:17x9x17 (metres, one spacing or three)";
    const auto parts = split(text, ':');
    if (parts.size() != 3) return expected(text, kForm);
    const auto origin = parseVector(parts[0]);
    const bool single = parts[1].find(',') == std::string_view::npos;
    const auto spacing = parseNumbers(parts[1], single ? 1 : 3);
    const auto counts = parseCounts(parts[2]);
    if (!origin || !spacing) return expected(text, kForm);
    if (!counts) return counts.error();
    VolumeDesc grid;
    grid.origin = *origin;
    grid.spacing = single ? glm::vec3((*spacing)[0]) : glm::vec3((*spacing)[0], (*spacing)[1], (*spacing)[2]);
    grid.counts = *counts;
    for (int axis = 0; axis < 3; ++axis)
        if (!(grid.spacing[axis] >= 1e-6f && grid.spacing[axis] <= 1e9f))
            return expected(text, "a volume: its spacing must be 1e-6 to 1e9 metres");
    return grid;
}

Result<PlacedLight> parseSun(std::string_view text) {
    const auto values = parseNumbers(text, 4);
    if (!values) return expected(text, "X,Y,Z,LUX (the direction in which the light travels, and W/m2)");
    const glm::vec3 direction((*values)[0], (*values)[1], (*values)[2]);
    const float length = glm::length(direction);
    if (!(length > 0) || !std::isfinite(length)) return expected(text, "a sun: its direction has no length");
    if ((*values)[3] < 0) return expected(text, "a sun: its LUX must be 0 or more");
    PlacedLight light;
    light.type = LightType::directional;
    light.direction = direction / length;
    light.intensity = glm::vec3((*values)[3]);
    return light;
}

Result<PlacedLight> parsePoint(std::string_view text) {
    const auto values = parseNumbers(text, 6);
    if (!values) return expected(text, "X,Y,Z,R,G,B (position in metres, intensity in W/sr)");
    PlacedLight light;
    light.type = LightType::point;
    light.position = {(*values)[0], (*values)[1], (*values)[2]};
    light.intensity = {(*values)[3], (*values)[4], (*values)[5]};
    if (!nonNegative(light.intensity)) return expected(text, "a point light: its R,G,B must be 0 or more");
    return light;
}

Result<PictureSize> parseSize(std::string_view text) {
    const auto parts = split(text, 'x');
    PictureSize size;
    const bool good = parts.size() == 2 && parseWhole(parts[0], size.width) && parseWhole(parts[1], size.height) &&
                      size.width >= 1 && size.width <= kMaxSide && size.height >= 1 && size.height <= kMaxSide;
    if (!good) return expected(text, "WxH with 1 to 16384 pixels each, e.g. 1280x720");
    return size;
}

Result<Exposure> parseExposure(std::string_view text) {
    if (text == "auto") return Exposure{true, {}};
    if (text == "scene") return Exposure{};
    const auto factor = parseNumbers(text, 1);
    if (!factor || !((*factor)[0] >= 1e-9f && (*factor)[0] <= 1e9f))
        return expected(text, "auto, scene, or a number from 1e-9 to 1e9");
    return Exposure{false, (*factor)[0]};
}

Result<UpdateBudget> parseBudget(std::string_view text) {
    UpdateBudget budget;
    const bool timed = text.ends_with("ms");
    const bool good =
        timed ? parseWhole(text.substr(0, text.size() - 2), budget.milliseconds) : parseWhole(text, budget.rays);
    if (!good || !budget.limits() || !(budget.milliseconds <= 1e6))
        return expected(text,
                        "a number of rays above 0, e.g. 20000, or of milliseconds above 0, up to 1000000, e.g. 4ms");
    return budget;
}

CLI::Validator inRange(double lower, double upper) {
    return CLI::Validator(
        [lower, upper](std::string& text) {
            double value = 0;
            if (parseWhole(std::string_view(text), value) && value >= lower && value <= upper) return std::string();
            return fmt::format("'{}' is not a number from {} to {}", text, lower, upper);
        },
        "");
}

void addUnpackLimit(CLI::App& command, ReadLimits& limits) {
    limits.name = "--unpack-limit";
    command
        .add_option("--unpack-limit", limits.megabytes,
                    "MB that the decoded pixels of a small file may take, its geometry a sixteenth of that; any file "
                    "may take 64 times its own size")
        ->type_name("MB")
        ->check(wholeNumber())
        ->check(inRange(1, 1 << 20))
        ->capture_default_str();
}

CLI::Validator wholeNumber() {
    return CLI::Validator(
        [](std::string& text) {
            std::uint64_t value = 0;
            if (parseWhole(std::string_view(text), value)) return std::string();
            return fmt::format("'{}' is not a whole number from 0 to 18446744073709551615", text);
        },
        "");
}

}  // namespace probegi::tool
