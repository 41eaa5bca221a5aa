#include <cmath>
#include <glm/gtc/constants.hpp>

#include "io/gltf_import.h"

namespace probegi::io {

namespace {

glm::vec3 intensityOf(Import& import, const std::string& user, const tinygltf::Light& light) {
    glm::vec3 intensity(0.0f);
    for (int c = 0; c < 3; ++c) {
        const double color = std::size_t(c) < light.color.size() ? light.color[std::size_t(c)] : 1.0;
        const float value = finiteFloat(user, "intensity", color * light.intensity);
        intensity[c] = std::clamp(value, 0.0f, checks::kBrightest);
        if (intensity[c] != value) import.warn(fmt::format("{}: intensity {} was limited", user, value));
    }
    return intensity;
}

void limitCone(Import& import, const std::string& user, Light& light) {
    constexpr float kSmallest = 1e-4f;
    const float outer = std::clamp(light.outerConeAngle, kSmallest, glm::half_pi<float>());
    const float inner = std::clamp(light.innerConeAngle, 0.0f, outer);
    if (outer != light.outerConeAngle || inner != light.innerConeAngle) {
        import.warn(fmt::format("{}: its cone angles were limited to {}..{} rad", user, inner, outer));
    }
    light.outerConeAngle = outer;
    light.innerConeAngle = inner;
}

Light importLight(Import& import, const std::string& user, const tinygltf::Light& l, LightType type) {
    Light light;
    light.name = l.name;
    light.type = type;
    light.intensity = intensityOf(import, user, l);
    light.range = std::max(0.0f, finiteFloat(user, "range", l.range));
    if (type == LightType::spot) {
        light.innerConeAngle = finiteFloat(user, "inner cone angle", l.spot.innerConeAngle);
        light.outerConeAngle = finiteFloat(user, "outer cone angle", l.spot.outerConeAngle);
        limitCone(import, user, light);
    }
    return light;
}

/// Returns whether ProbeGI supports the camera.
bool importCamera(Import& import, const std::string& user, const tinygltf::Camera& c) {
    if (c.type != "perspective") {
        import.warn(fmt::format("{} is {}; only perspective cameras are supported, it is left out", user, c.type));
        return false;
    }
    Camera camera;
    camera.name = c.name;
    camera.yfov = finiteFloat(user, "yfov", c.perspective.yfov);
    camera.znear = finiteFloat(user, "znear", c.perspective.znear);
    if (!(camera.yfov > 0 && camera.yfov < glm::pi<float>()) || camera.znear < 0) {
        import.warn(
            fmt::format("{}: yfov {} or znear {} is out of range, it is left out", user, camera.yfov, camera.znear));
        return false;
    }
    import.scene().cameras.push_back(camera);
    return true;
}

}  // namespace

void importLights(Import& import) {
    for (std::size_t i = 0; i < import.model.lights.size(); ++i) {
        const tinygltf::Light& l = import.model.lights[i];
        const std::string user = title("light", i, l.name);
        LightType type = LightType::point;
        if (l.type == "directional") {
            type = LightType::directional;
        } else if (l.type == "spot") {
            type = LightType::spot;
        } else if (l.type != "point") {
            import.warn(fmt::format("{} has an unknown type and is left out", user));
            import.lights.push_back(-1);
            continue;
        }
        import.lights.push_back(int(import.scene().lights.size()));
        import.scene().lights.push_back(importLight(import, user, l, type));
    }
}

void importCameras(Import& import) {
    for (std::size_t i = 0; i < import.model.cameras.size(); ++i) {
        const tinygltf::Camera& c = import.model.cameras[i];
        const int slot = int(import.scene().cameras.size());
        import.cameras.push_back(importCamera(import, title("camera", i, c.name), c) ? slot : -1);
    }
}

}  // namespace probegi::io
