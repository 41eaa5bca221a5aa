#include "io/harness_ini.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <optional>

#include "io/refused.h"

namespace probegi::io {

namespace {

/// Full key, e.g. "scene.lights.0.color" -> the words of its value.
using Settings = std::map<std::string, std::vector<std::string>>;

Settings parse(std::istream& stream) {
    Settings settings;
    for (const CLI::ConfigItem& item : CLI::ConfigBase().from_config(stream)) {
        settings[item.fullname()] = item.inputs;
    }
    return settings;
}

/// "1", "1.0" or C's "1.f".
float numberOf(const std::string& key, const std::string& word) {
    float value = 0;
    const char* end = word.data() + word.size();
    auto [rest, error] = std::from_chars(word.data(), end, value);
    if (rest != end && *rest == 'f') ++rest;
    if (error != std::errc() || rest != end || !std::isfinite(value)) {
        refuseMalformed("the setting {} has the value '{}', which is not a number", key, word);
    }
    return value;
}

float number(const Settings& settings, const std::string& key, float fallback) {
    const auto found = settings.find(key);
    if (found == settings.end() || found->second.empty()) return fallback;
    return numberOf(key, found->second[0]);
}

glm::vec3 vector(const Settings& settings, const std::string& key, glm::vec3 fallback) {
    const auto found = settings.find(key);
    if (found == settings.end()) return fallback;
    const std::vector<std::string>& words = found->second;
    if (words.size() != 3) refuseMalformed("the setting {} has {} numbers; it needs three", key, words.size());
    return {numberOf(key, words[0]), numberOf(key, words[1]), numberOf(key, words[2])};
}

std::string text(const Settings& settings, const std::string& key) {
    const auto found = settings.find(key);
    return found == settings.end() ? std::string() : fmt::format("{}", fmt::join(found->second, " "));
}

bool contains(const Settings& settings, const std::string& key) {
    return settings.find(key) != settings.end();
}

/// The rotation that points a node's -Z axis along a direction.
glm::quat facing(const std::string& key, glm::vec3 direction) {
    const float length = glm::length(direction);
    if (!(length > 1e-12f) || !std::isfinite(length)) refuseMalformed("the setting {} has no direction", key);
    direction /= length;
    const bool vertical = std::abs(direction.y) > 0.999f;
    return glm::quatLookAt(direction, vertical ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0));
}

LightType lightTypeOf(const std::string& key, float code) {
    if (code == 0) return LightType::directional;
    if (code == 1) return LightType::spot;
    if (code == 2) return LightType::point;
    refuseMalformed("the setting {} is {}; it must be 0 (directional), 1 (spot) or 2 (point)", key, code);
}

void addLight(const Settings& settings, const std::string& key, Scene& scene) {
    const float power = number(settings, key + "power", 1.0f);
    if (power == 0.0f) return;  // the harness' way to switch one off
    Light light;
    light.name = text(settings, key + "name");
    light.type = lightTypeOf(key + "type", number(settings, key + "type", 0.0f));
    light.intensity = power * vector(settings, key + "color", glm::vec3(1.0f));
    if (light.type != LightType::directional) light.range = number(settings, key + "radius", 0.0f);
    if (light.type == LightType::spot) {
        constexpr float kLargest = 90.0f;
        const float outer = std::clamp(number(settings, key + "penumbraAngle", 45.0f), 0.01f, kLargest);
        const float inner = std::clamp(number(settings, key + "umbraAngle", 0.0f), 0.0f, outer);
        light.outerConeAngle = glm::radians(outer);
        light.innerConeAngle = std::min(glm::radians(inner), light.outerConeAngle);
    }
    Node node;
    node.name = light.name;
    node.translation = vector(settings, key + "position", glm::vec3(0.0f));
    if (light.type != LightType::point) {
        node.rotation = facing(key + "direction", vector(settings, key + "direction", glm::vec3(0, -1, 0)));
    }
    node.light = int(scene.lights.size());
    scene.lights.push_back(light);
    scene.addNode(node);
}

void addCamera(const Settings& settings, const std::string& key, Scene& scene) {
    Camera camera;
    camera.name = text(settings, key + "name");
    camera.yfov = glm::radians(number(settings, key + "fov", 45.0f));
    const float yaw = glm::radians(number(settings, key + "yaw", 0.0f));
    const float pitch = glm::radians(number(settings, key + "pitch", 0.0f));
    Node node;
    node.name = camera.name;
    node.translation = vector(settings, key + "position", glm::vec3(0.0f));
    node.rotation =
        facing(key + "pitch", {std::sin(yaw) * std::cos(pitch), -std::sin(pitch), -std::cos(yaw) * std::cos(pitch)});
    node.camera = int(scene.cameras.size());
    scene.cameras.push_back(camera);
    scene.addNode(node);
}

// `key`: "ddgi.volume.0."
std::optional<VolumeDesc> gridOf(const Settings& settings, const std::string& key) {
    if (!contains(settings, key + "probeCounts")) return {};
    constexpr float kMostPerAxis = 1024;  // far below where a float stops being an integer
    VolumeDesc grid;
    const glm::vec3 counts = vector(settings, key + "probeCounts", glm::vec3(2.0f));
    for (int axis = 0; axis < 3; ++axis) {
        if (!(counts[axis] >= 2 && counts[axis] <= kMostPerAxis)) {
            refuseMalformed("the setting {}probeCounts has {} probes on an axis; 2 to 1024 are supported", key,
                            counts[axis]);
        }
    }
    grid.counts = glm::ivec3(counts);
    grid.spacing = vector(settings, key + "probeSpacing", glm::vec3(1.0f));
    const glm::vec3 degrees = vector(settings, key + "rotation", glm::vec3(0.0f));
    if (degrees != glm::vec3(0.0f)) grid.orientation = glm::normalize(glm::quat(glm::radians(degrees)));
    const glm::vec3 centre = vector(settings, key + "origin", glm::vec3(0.0f));
    const glm::vec3 half = 0.5f * grid.spacing * glm::vec3(grid.counts - 1);
    grid.origin = centre - (degrees == glm::vec3(0.0f) ? half : grid.orientation * half);
    return grid;
}

/// Calls add("scene.lights.0."), ... for as long as such entries exist.
template <class Add>
void forEachEntry(const Settings& settings, const std::string& list, const Add& add) {
    for (int i = 0;; ++i) {
        const std::string prefix = fmt::format("{}.{}.", list, i);
        const auto first = settings.lower_bound(prefix);
        if (first == settings.end() || first->first.compare(0, prefix.size(), prefix) != 0) return;
        add(prefix);
    }
}

/// The numbers of the probe volumes, in their order.
std::vector<int> volumeNumbers(const Settings& settings) {
    constexpr std::string_view kPrefix = "ddgi.volume.";
    std::vector<int> numbers;
    for (auto entry = settings.lower_bound(std::string(kPrefix)); entry != settings.end(); ++entry) {
        if (entry->first.compare(0, kPrefix.size(), kPrefix) != 0) break;
        const char *begin = entry->first.data() + kPrefix.size(), *end = entry->first.data() + entry->first.size();
        int number = 0;
        const auto [rest, error] = std::from_chars(begin, end, number);
        if (error == std::errc() && rest != end && *rest == '.' && number >= 0) numbers.push_back(number);
    }
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

bool saysYes(const Settings& settings, const std::string& key) {
    const std::string value = text(settings, key);
    return !value.empty() && value != "0" && value != "false";
}

/// Adds all probe volumes; a sentence for each setting of theirs that is not used.
std::vector<std::string> addVolumes(const Settings& settings, Scene& scene) {
    std::vector<std::string> ignored;
    std::vector<VolumeDesc> grids;
    for (const int number : volumeNumbers(settings)) {
        const std::string key = fmt::format("ddgi.volume.{}.", number);
        const auto grid = gridOf(settings, key);
        if (!grid && number > 0)
            ignored.push_back(fmt::format("the probe volume ddgi.volume.{} is ignored: it has no probeCounts", number));
        if (saysYes(settings, key + "infiniteScrolling.enabled"))
            ignored.push_back(
                fmt::format("the setting {}infiniteScrolling.enabled is ignored: the probe grid does not scroll", key));
        if (grid) grids.push_back(*grid);
    }
    if (!grids.empty()) {
        scene.grid = grids.front();
        scene.furtherGrids.assign(grids.begin() + 1, grids.end());
    }
    return ignored;
}

}  // namespace

std::vector<std::string> addHarnessSettings(std::istream& stream, Scene& scene) {
    const Settings settings = parse(stream);
    forEachEntry(settings, "scene.lights", [&](const std::string& key) { addLight(settings, key, scene); });
    forEachEntry(settings, "scene.cameras", [&](const std::string& key) { addCamera(settings, key, scene); });
    if (contains(settings, "scene.skyColor")) {
        scene.sky.radiance =
            number(settings, "scene.skyIntensity", 1.0f) * vector(settings, "scene.skyColor", glm::vec3(0.0f));
    }
    return addVolumes(settings, scene);
}

}  // namespace probegi::io
