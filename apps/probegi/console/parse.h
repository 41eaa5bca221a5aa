#pragma once

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "probegi/image.h"
#include "probegi/tracer.h"
#include "probegi/update_budget.h"
#include "probegi/volume.h"

namespace probegi::tool {

// Parsers for command-line arguments. Errors name what was expected. Nothing throws.

/// Exactly `count` finite numbers separated by commas, e.g. "1,-0.5,2".
Result<std::vector<float>> parseNumbers(std::string_view text, std::size_t count);

Result<glm::vec3> parseVector(std::string_view text);   ///< "X,Y,Z"
Result<glm::ivec3> parseCounts(std::string_view text);  ///< "XxYxZ", each 2..1024, at most 2^24 in all
Result<VolumeDesc> parseVolume(std::string_view text);  ///< "X,Y,Z:S:XxYxZ" or "X,Y,Z:SX,SY,SZ:XxYxZ"
Result<PlacedLight> parseSun(std::string_view text);    ///< "X,Y,Z,LUX": the direction in which the light travels
Result<PlacedLight> parsePoint(std::string_view text);  ///< "X,Y,Z,R,G,B": position, intensity in W/sr

struct PictureSize {
    int width = 960;
    int height = 540;
};
Result<PictureSize> parseSize(std::string_view text);  ///< "WxH", each 1..16384

/// The value of --exposure.
struct Exposure {
    bool automatic = false;       ///< "auto": chosen for the picture
    std::optional<float> factor;  ///< empty without automatic, "scene": what the scene suggests
};
Result<Exposure> parseExposure(std::string_view text);  ///< "auto", "scene" or a number, 1e-9..1e9

Result<UpdateBudget> parseBudget(std::string_view text);  ///< "RAYS", or "MSms": milliseconds; above 0

/// Replaces CLI11's range check, which accepts NaN and does not name the option.
CLI::Validator inRange(double lower, double upper);

/// Rejects negative numbers for unsigned options, which CLI11 would wrap around.
CLI::Validator wholeNumber();

/// Adds --unpack-limit, and puts its name into the limits, for their error messages.
void addUnpackLimit(CLI::App& command, ReadLimits& limits);

/// For oneOf(): the values of a switch.
inline const std::map<std::string, bool> kOnOff{{"on", true}, {"off", false}};

/// Turns the name of an enumerator into its number, which CLI11 reads; rejects other names, listing the valid ones.
template <class Enum>
CLI::Validator oneOf(const std::map<std::string, Enum>& names) {
    return CLI::Validator(
        [names](std::string& text) {
            const auto found = names.find(text);
            if (found != names.end()) {
                text = std::to_string(int(found->second));
                return std::string();
            }
            std::string known;
            for (const auto& [name, value] : names) known += (known.empty() ? "" : ", ") + name;
            return "'" + text + "' is none of " + known;
        },
        "");
}

/// Turns one of the parsers above into a CLI11 validator.
template <class Parser>
CLI::Validator parsedBy(Parser parser) {
    return CLI::Validator(
        [parser](std::string& text) {
            const auto result = parser(text);
            return result ? std::string() : result.error().message;
        },
        "");
}

}  // namespace probegi::tool
