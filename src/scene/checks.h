#pragma once

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "core/sentence.h"
#include "probegi/scene.h"

/// Small predicates and the common form of validate()'s messages: "WHAT: WHY".
namespace probegi::checks {

inline bool finite(float v) {
    return std::isfinite(v);
}
inline bool finite(glm::vec2 v) {
    return finite(v.x) && finite(v.y);
}
inline bool finite(glm::vec3 v) {
    return finite(v.x) && finite(v.y) && finite(v.z);
}
inline bool finite(glm::vec4 v) {
    return finite(v.x) && finite(v.y) && finite(v.z) && finite(v.w);
}
inline bool finite(const glm::mat3& m) {
    return finite(m[0]) && finite(m[1]) && finite(m[2]);
}
inline bool finite(const glm::mat4& m) {
    return finite(m[0]) && finite(m[1]) && finite(m[2]) && finite(m[3]);
}

/// lower <= v <= upper, false for NaN.
inline bool within(float v, float lower, float upper) {
    return v >= lower && v <= upper;
}

/// Limit for light, W sr^-1 m^-2 or a lamp's unit: from 1e21 on probes can no longer store it, and sums of the largest
/// floats are infinite.
inline constexpr float kBrightest = 1e20f;

/// From 0 to kBrightest.
inline bool energy(glm::vec3 v) {
    return within(v.x, 0, kBrightest) && within(v.y, 0, kBrightest) && within(v.z, 0, kBrightest);
}

inline std::string text(glm::vec3 v) {
    return sentence("(", v.x, ", ", v.y, ", ", v.z, ")");
}
inline std::string text(glm::vec4 v) {
    return sentence("(", v.x, ", ", v.y, ", ", v.z, ", ", v.w, ")");
}

/// A name from a file, shortened for a message: names may have any length.
inline std::string quotable(std::string_view name) {
    constexpr std::size_t kMost = 80;
    if (name.size() <= kMost) return std::string(name);
    std::size_t end = kMost;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;  // not within a UTF-8 character
    return std::string(name.substr(0, end)) + "...";
}

/// "material 3 'brick'", or "material 3" for one without a name.
inline std::string title(std::string_view kind, std::size_t index, std::string_view name) {
    return name.empty() ? sentence(kind, " ", index) : sentence(kind, " ", index, " '", quotable(name), "'");
}

template <class... Parts>
[[nodiscard]] Error malformed(const Parts&... parts) {
    return fail(ErrorCode::malformed, sentence(parts...));
}

/// An index into a list of `count`, or -1 for none.
inline bool optionalIndex(int index, std::size_t count) {
    return index == -1 || (index >= 0 && std::size_t(index) < count);
}

}  // namespace probegi::checks

namespace probegi {

// The parts of validate(), one per list of the scene.
Result<void> validateImages(const Scene& scene);
Result<void> validateMaterials(const Scene& scene);
Result<void> validateMeshes(const Scene& scene);
Result<void> validateLightsAndCameras(const Scene& scene);
Result<void> validateNodes(const Scene& scene);
Result<void> validateAnimations(const Scene& scene);
Result<void> validateSurroundings(const Scene& scene);

}  // namespace probegi
