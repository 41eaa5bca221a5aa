#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_parts.h"

namespace probegi::builtin {

namespace {

double areaOf(const Primitive& p) {
    double area = 0;
    for (std::size_t i = 0; i < p.indices.size(); i += 3) {
        const glm::dvec3 a(p.positions[p.indices[i]]), b(p.positions[p.indices[i + 1]]),
            c(p.positions[p.indices[i + 2]]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return area;
}

}  // namespace

/// A sphere of radius R and albedo a, seen from inside, with a point light of power P at its centre. All power is
/// eventually absorbed, so the irradiance of bounced light is P a / (4 pi R^2 (1 - a)) everywhere.
///
/// Its 20,480 flat facets have together exactly the area 4 pi R^2 (the vertices lie a little outside R, the facets'
/// middles a little inside), so the mean over the surface is exact and the facets affect only the spread.
Result<Scene> makeSphere(const BuiltinParams& params) {
    if (auto r = requireWithin("albedo", params.albedo, 0, 0.99f); !r) return r.error();
    if (auto r = requirePositive("power", params.power); !r) return r.error();
    if (auto r = requirePositive("radius", params.radius); !r) return r.error();
    Scene scene;
    scene.name = "sphere";
    const float radius = params.radius;
    const int wall = addMaterial(scene, "wall", glm::vec3(params.albedo));

    MeshBuilder builder(wall);
    addGeodesicSphere(builder, 5, [](glm::vec3) { return 1.0f; });
    Primitive sphere = builder.take();
    const float scale = radius * float(std::sqrt(4 * glm::pi<double>() / areaOf(sphere)));
    for (glm::vec3& p : sphere.positions) p *= scale;
    for (glm::vec3& n : sphere.normals) n = -n;
    for (std::size_t i = 0; i < sphere.indices.size(); i += 3) std::swap(sphere.indices[i + 1], sphere.indices[i + 2]);
    place(scene, addMesh(scene, {"sphere", {std::move(sphere)}}));

    const float intensity = params.power / (4 * glm::pi<float>());
    addPointLight(scene, "lamp", glm::vec3(0), glm::vec3(intensity));
    addCamera(scene, "inside", {0, 0, 0.6f * radius}, glm::vec3(0), 75);
    // Direct plus bounced light as a light grey.
    const float irradiance = intensity / (radius * radius) / (1 - params.albedo);
    scene.exposure = 0.5f * glm::pi<float>() / (std::max(params.albedo, 0.05f) * irradiance);
    return scene;
}

}  // namespace probegi::builtin
