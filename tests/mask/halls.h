#pragma once

#include "mask/mask_cubes.h"
#include "probegi/shapes.h"
#include "support/field_setup.h"

namespace probegi::test {

/// A hall of 4 x 3 x 4 m about the origin, divided by a wall of a centimetre that stands across x at `wall`.
struct Halls {
    static constexpr float kHalfWall = 0.005f;

    explicit Halls(float wall = 0.0f, int threads = 1) : context(*Context::create({.threads = threads})) {
        scene.materials.resize(1);
        Primitive room, divider;
        addRoom(room, {-2, 0, -2}, {2, 3, 2});
        addBox(divider, {wall - kHalfWall, -0.01f, -2.01f}, {wall + kHalfWall, 3.01f, 2.01f});
        addObject(scene, std::move(room));
        addObject(scene, std::move(divider));
        finish();
    }
    /// Any scene.
    Halls(Scene made, int threads) : context(*Context::create({.threads = threads})), scene(std::move(made)) {
        finish();
    }

    void finish() {
        pose = poseAt(scene);
        tracer = makeEmbreeTracer(context, scene, pose).value();
        occluders = triangleBounds(scene, pose);
    }

    /// Probes at 0.7 m, none of them on a wall.
    static FieldDesc field() {
        FieldDesc desc;
        desc.volumes = {{{-2.3f, -0.4f, -2.4f}, glm::vec3(0.7f), {8, 6, 8}}};
        return desc;
    }
    Result<std::shared_ptr<const Masks>> tryBake(MaskDesc desc = {}, const FieldDesc& of = field()) const {
        desc.occluders = occluders;
        return bakeMasks(context, *tracer, of, desc);
    }
    std::shared_ptr<const Masks> bake(const MaskDesc& desc = {}, const FieldDesc& of = field()) const {
        return tryBake(desc, of).value();
    }

    Context context;
    Scene scene;
    ScenePose pose;
    std::unique_ptr<Tracer> tracer;
    std::vector<Bounds> occluders;
};

/// The word of a texel of the cell whose lowest probe is in a slot.
inline std::uint32_t texelAt(const Masks& masks, int slot, glm::ivec3 texel) {
    const std::size_t first = masks.words()[2 * std::size_t(slot)];
    const int t = texel.x + masks.factor() * (texel.y + masks.factor() * texel.z);
    if (!masks.packed()) return masks.words()[first + std::size_t(t)];
    return masks.words()[first + std::size_t(t) / 2] >> (16 * (t % 2)) & 0xffffu;
}

/// The mask at a texel of the cell whose lowest probe is in a slot.
inline unsigned maskAt(const Masks& masks, int slot, glm::ivec3 texel) {
    const std::uint32_t word = texelAt(masks, slot, texel);
    return (word & 15u) | (word >> 12 & 0xf0u);
}

}  // namespace probegi::test
