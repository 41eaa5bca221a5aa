#include "scene/builtin/box_solid.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_parts.h"

namespace probegi::builtin {

/// 4 x 3 x 4 m, every wall with the same albedo a and emission Le, so that E = pi Le / (1 - a) at every point inside
/// and for every normal. The walls are sheets that face inwards; there is nothing outside.
Result<Scene> makeFurnace(const BuiltinParams& params) {
    if (auto r = requireWithin("albedo", params.albedo, 0, 0.99f); !r) return r.error();
    if (auto r = requirePositive("emission", params.emission); !r) return r.error();
    Scene scene;
    scene.name = "furnace";
    const int wall = addEmitter(scene, "wall", glm::vec3(params.emission));
    scene.materials[std::size_t(wall)].baseColor = glm::vec4(glm::vec3(params.albedo), 1);

    MeshBuilder box(wall);
    const glm::vec3 lo(-2, 0, -2), hi(2, 3, 2);
    // An inverted box.
    box.quad({hi.x, hi.y, hi.z}, {hi.x, hi.y, lo.z}, {hi.x, lo.y, lo.z}, {hi.x, lo.y, hi.z});
    box.quad({lo.x, hi.y, lo.z}, {lo.x, hi.y, hi.z}, {lo.x, lo.y, hi.z}, {lo.x, lo.y, lo.z});
    box.quad({lo.x, hi.y, lo.z}, {hi.x, hi.y, lo.z}, {hi.x, hi.y, hi.z}, {lo.x, hi.y, hi.z});
    box.quad({lo.x, lo.y, hi.z}, {hi.x, lo.y, hi.z}, {hi.x, lo.y, lo.z}, {lo.x, lo.y, lo.z});
    box.quad({lo.x, hi.y, hi.z}, {hi.x, hi.y, hi.z}, {hi.x, lo.y, hi.z}, {lo.x, lo.y, hi.z});
    box.quad({hi.x, hi.y, lo.z}, {lo.x, hi.y, lo.z}, {lo.x, lo.y, lo.z}, {hi.x, lo.y, lo.z});
    place(scene, addMesh(scene, "furnace", {std::move(box)}));
    addCamera(scene, "inside", {1.4f, 1.6f, 1.5f}, {-1, 1.3f, -1}, 60);
    // Every wall's outgoing radiance is Le / (1 - a): shown as middle grey.
    scene.exposure = 0.5f * (1 - params.albedo) / params.emission;
    return scene;
}

}  // namespace probegi::builtin
