#include "scene/animation.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/checks.h"

namespace probegi {

namespace {

glm::quat toQuat(glm::vec4 v) {
    return glm::quat(v.w, v.x, v.y, v.z);
}
glm::vec4 toVec4(glm::quat q) {
    return {q.x, q.y, q.z, q.w};
}

/// Spherical interpolation along the shorter arc.
glm::vec4 slerp(glm::vec4 a, glm::vec4 b, float t) {
    return toVec4(glm::normalize(glm::slerp(toQuat(glm::normalize(a)), toQuat(glm::normalize(b)), t)));
}

/// Cubic Hermite spline between keys k and k + 1, `span` seconds apart.
glm::vec4 hermite(const AnimationChannel& c, std::size_t k, float t, float span) {
    const glm::vec4 from = c.values[3 * k + 1];
    const glm::vec4 outTangent = span * c.values[3 * k + 2];
    const glm::vec4 inTangent = span * c.values[3 * k + 3];
    const glm::vec4 to = c.values[3 * k + 4];
    const float t2 = t * t;
    const float t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * from + (t3 - 2 * t2 + t) * outTangent + (3 * t2 - 2 * t3) * to +
           (t3 - t2) * inTangent;
}

glm::vec4 rawSample(const AnimationChannel& c, float seconds) {
    const bool spline = c.interpolation == Interpolation::cubicSpline;
    const auto key = [&](std::size_t k) { return c.values[spline ? 3 * k + 1 : k]; };
    if (!(seconds > c.times.front())) return key(0);
    if (seconds >= c.times.back()) return key(c.times.size() - 1);
    const std::size_t next = std::size_t(std::upper_bound(c.times.begin(), c.times.end(), seconds) - c.times.begin());
    const std::size_t k = next - 1;
    const float span = c.times[next] - c.times[k];
    const float t = (seconds - c.times[k]) / span;
    if (c.interpolation == Interpolation::step) return key(k);
    if (spline) return hermite(c, k, t, span);
    if (c.path == AnimationPath::rotation) return slerp(key(k), key(next), t);
    return glm::mix(key(k), key(next), t);
}

}  // namespace

glm::vec4 sampleChannel(const AnimationChannel& channel, float seconds) {
    const glm::vec4 value = rawSample(channel, seconds);
    if (channel.path != AnimationPath::rotation) return value;
    // A spline may pass through zero between two valid keys; use the identity there.
    const float length = glm::length(value);
    return length > 1e-12f ? value / length : glm::vec4(0, 0, 0, 1);
}

namespace {

Result<void> validateChannel(const Scene& scene, const std::string& what, const AnimationChannel& c) {
    using namespace checks;
    if (c.node < 0 || std::size_t(c.node) >= scene.nodes.size()) {
        return malformed(what, ": moves node ", c.node, ", but the scene has ", scene.nodes.size());
    }
    if (c.times.empty()) return malformed(what, ": there is no keyframe");
    for (std::size_t k = 0; k < c.times.size(); ++k) {
        if (!finite(c.times[k])) return malformed(what, ": the time of key ", k, " is not finite");
        if (k > 0 && c.times[k] <= c.times[k - 1]) {
            return malformed(what, ": key ", k, " at ", c.times[k], " s does not come after key ", k - 1, " at ",
                             c.times[k - 1], " s");
        }
    }
    const std::size_t perKey = c.interpolation == Interpolation::cubicSpline ? 3 : 1;
    if (c.values.size() != perKey * c.times.size()) {
        return malformed(what, ": ", c.values.size(), " values for ", c.times.size(), " keys; there must be ", perKey,
                         " a key");
    }
    for (std::size_t v = 0; v < c.values.size(); ++v) {
        if (!finite(c.values[v])) return malformed(what, ": value ", v, " is not finite");
        const bool isKey = perKey == 1 || v % 3 == 1;
        if (c.path == AnimationPath::rotation && isKey && glm::dot(c.values[v], c.values[v]) < 1e-12f) {
            return malformed(what, ": value ", v, " is a rotation of length zero");
        }
    }
    return {};
}

}  // namespace

Result<void> validateAnimations(const Scene& scene) {
    for (std::size_t i = 0; i < scene.animations.size(); ++i) {
        if (auto r = validateChannel(scene, checks::title("animation channel", i, ""), scene.animations[i]); !r) {
            return r;
        }
    }
    return {};
}

}  // namespace probegi
