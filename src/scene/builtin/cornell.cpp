#include <array>

#include "scene/builtin/box_solid.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_parts.h"

namespace probegi::builtin {

namespace {

/// A block with the given corners on the floor, counter-clockwise from above. It floats half a millimetre, so that rays
/// from inside hit its own underside, not the floor's front.
Mesh block(const char* name, int material, const std::array<glm::vec2, 4>& corners, float height) {
    constexpr float kGap = 0.0005f;
    MeshBuilder out(material);
    const auto at = [](glm::vec2 xz, float y) { return glm::vec3(xz.x, y, xz.y); };
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec2 a = corners[i], b = corners[(i + 1) % 4];
        out.quad(at(a, kGap), at(b, kGap), at(b, height), at(a, height));
    }
    out.quad(at(corners[0], height), at(corners[1], height), at(corners[2], height), at(corners[3], height));
    out.quad(at(corners[3], kGap), at(corners[2], kGap), at(corners[1], kGap), at(corners[0], kGap));
    Mesh mesh{name, {}};
    mesh.primitives.push_back(out.take());
    return mesh;
}

}  // namespace

/// The box that Cornell University measured, scaled by ten: 5.5 m a side. The camera looks along -Z, so the measured z
/// axis, which points into the box, is reversed.
Result<Scene> makeCornell(const BuiltinParams&) {
    Scene scene;
    scene.name = "cornell";
    const int white = addMaterial(scene, "white", {0.725f, 0.71f, 0.68f});
    const int red = addMaterial(scene, "red", {0.63f, 0.065f, 0.05f});
    const int green = addMaterial(scene, "green", {0.14f, 0.45f, 0.091f});
    const int lamp = addEmitter(scene, "lamp", {17.0f, 12.0f, 4.0f});

    constexpr float kWidth = 5.528f, kHeight = 5.488f, kDepth = 5.592f, kWall = 0.2f;
    BoxSolid box;
    box.fill({-kWall, -kWall, -kDepth - kWall}, {kWidth + kWall, kHeight + kWall, 0}, white);
    Paint paint = Paint::all(white);
    paint.byNormal[0] = red;  // the left wall faces +X
    paint.byNormal[1] = green;
    box.carve({0, 0, -kDepth}, {kWidth, kHeight, kWall}, paint);
    place(scene, addMesh(scene, box.build("walls")));

    // The measured corners, rotated by 180 degrees about the vertical: red stays on the left of the picture.
    const auto xz = [](float x, float z) { return glm::vec2(kWidth - x, -z); };
    const std::array shortBlock{xz(1.30f, 0.65f), xz(0.82f, 2.25f), xz(2.40f, 2.72f), xz(2.90f, 1.14f)};
    place(scene, addMesh(scene, block("short block", white, shortBlock, 1.65f)));
    const std::array tallBlock{xz(4.23f, 2.47f), xz(2.65f, 2.96f), xz(3.14f, 4.56f), xz(4.72f, 4.06f)};
    place(scene, addMesh(scene, block("tall block", white, tallBlock, 3.30f)));

    // A slab that protrudes from the ceiling by a centimetre; only its underside glows.
    constexpr glm::vec3 kLower(kWidth - 3.43f, kHeight - 0.01f, -3.32f),
        kUpper(kWidth - 2.13f, kHeight + 0.05f, -2.27f);
    BoxSolid panel;
    panel.fill(kLower, kUpper, white);
    Paint glow;
    glow.byNormal[3] = lamp;
    panel.carve({kLower.x, kLower.y - 0.01f, kLower.z}, {kUpper.x, kLower.y, kUpper.z}, glow);
    place(scene, addMesh(scene, panel.build("lamp")));

    addCamera(scene, "front", {2.78f, 2.73f, 8.0f}, {2.78f, 2.73f, 0}, 39.3f);
    addCamera(scene, "inside", {0.6f, 3.6f, -0.3f}, {3.6f, 1.6f, -4.2f}, 70);
    scene.exposure = 1.5f;
    return scene;
}

}  // namespace probegi::builtin
