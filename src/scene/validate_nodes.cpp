#include <glm/gtc/constants.hpp>

#include "scene/checks.h"

namespace probegi {

using namespace checks;

namespace {

Result<void> validateLight(const std::string& what, const Light& light) {
    if (!energy(light.intensity)) {
        return malformed(what, ": intensity ", text(light.intensity), " must be 0 to ", kBrightest);
    }
    if (!finite(light.range) || light.range < 0) {
        return malformed(what, ": range ", light.range, " must be finite and >= 0 (0: unlimited)");
    }
    if (light.type != LightType::spot) return {};
    constexpr float kHalfPi = glm::half_pi<float>();
    if (!within(light.outerConeAngle, 0, kHalfPi + 1e-5f) || light.outerConeAngle == 0) {
        return malformed(what, ": outer cone angle ", light.outerConeAngle, " must be above 0 and at most pi/2");
    }
    if (!within(light.innerConeAngle, 0, light.outerConeAngle)) {
        return malformed(what, ": inner cone angle ", light.innerConeAngle, " must be 0..", light.outerConeAngle,
                         ", the outer one");
    }
    return {};
}

Result<void> validateTransform(const std::string& what, const Node& node) {
    if (node.matrix) {
        const glm::mat4& m = *node.matrix;
        if (!finite(m)) return malformed(what, ": the matrix is not finite");
        const glm::vec4 lastRow(m[0][3], m[1][3], m[2][3], m[3][3]);
        if (lastRow != glm::vec4(0, 0, 0, 1)) {
            return malformed(what, ": the matrix's last row is ", text(lastRow), "; it must be (0, 0, 0, 1)");
        }
        return {};
    }
    if (!finite(node.translation)) {
        return malformed(what, ": translation ", text(node.translation), " must be finite");
    }
    if (!finite(node.scale)) return malformed(what, ": scale ", text(node.scale), " must be finite");
    const glm::vec4 q(node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w);
    if (!finite(q) || dot(q, q) < 1e-12f) {
        return malformed(what, ": rotation ", text(q), " (xyzw) must be finite and not zero");
    }
    return {};
}

Result<void> validateLink(const std::string& what, const char* kind, int index, std::size_t count) {
    if (optionalIndex(index, count)) return {};
    return malformed(what, ": uses ", kind, " ", index, ", but the scene has ", count);
}

}  // namespace

Result<void> validateLightsAndCameras(const Scene& scene) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (auto r = validateLight(title("light", i, light.name), light); !r) return r;
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const Camera& camera = scene.cameras[i];
        const std::string what = title("camera", i, camera.name);
        if (!(camera.yfov > 0 && camera.yfov < glm::pi<float>())) {
            return malformed(what, ": vertical field of view ", camera.yfov, " must be above 0 and below pi");
        }
        if (!finite(camera.znear) || camera.znear < 0) {
            return malformed(what, ": near plane ", camera.znear, " must be finite and >= 0");
        }
    }
    return {};
}

Result<void> validateNodes(const Scene& scene) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const std::string what = title("node", i, node.name);
        if (node.parent < -1 || node.parent >= int(i)) {
            return malformed(what, ": parent ", node.parent, " must be -1 or a node that comes before it");
        }
        if (auto r = validateTransform(what, node); !r) return r;
        if (auto r = validateLink(what, "mesh", node.mesh, scene.meshes.size()); !r) return r;
        if (auto r = validateLink(what, "light", node.light, scene.lights.size()); !r) return r;
        if (auto r = validateLink(what, "camera", node.camera, scene.cameras.size()); !r) return r;
    }
    return {};
}

}  // namespace probegi
