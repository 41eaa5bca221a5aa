// Alpha masks: rays pass through holes, for closest hits and for occlusion.
#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

/// A checkerboard of 4 x 4 cells over the quad: transparent where the sum of the cell numbers is even.
std::vector<std::uint8_t> checker(std::uint8_t transparent, std::uint8_t solid) {
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < 16; ++i) {
        const std::uint8_t alpha = (i % 4 + i / 4) % 2 == 0 ? transparent : solid;
        rgba.insert(rgba.end(), {200, 200, 200, alpha});
    }
    return rgba;
}

struct Masked : TestScene {
    explicit Masked(AlphaMode mode, float cutoff, std::uint8_t transparent, std::uint8_t solid, float factor = 1.0f) {
        Material material;
        material.alphaMode = mode;
        material.alphaCutoff = cutoff;
        material.baseColor.a = factor;
        material.baseColorTexture.image = addImage(4, 4, checker(transparent, solid));
        material.baseColorTexture.nearest = true;
        add(quad(addMaterial(material)));
        add(quad(), glm::translate(glm::mat4(1.0f), glm::vec3(0, -5, 0)));
    }
};

/// Rays straight down through the middle of each cell, to just below the masked quad or beyond the solid one.
void expectHoles(const Tracer& tracer, bool evenCellsOpen, bool oddCellsOpen) {
    for (int cell = 0; cell < 16; ++cell) {
        const int x = cell % 4, z = cell / 4;
        const bool open = (x + z) % 2 == 0 ? evenCellsOpen : oddCellsOpen;
        const glm::vec3 origin(-0.75f + 0.5f * float(x), 1.0f, -0.75f + 0.5f * float(z));
        const Shot far = shoot(tracer, rayAlong(origin, {0, -1, 0}));
        EXPECT_FLOAT_EQ(far.hit.distance, open ? 6.0f : 1.0f) << cell;  // Embree divides by approximate reciprocals
        EXPECT_TRUE(far.blocked);
        const Shot near = shoot(tracer, {origin, 0.0f, {0, -1, 0}, 3.0f});
        EXPECT_EQ(near.hit.valid(), !open) << cell;
        EXPECT_EQ(near.blocked, !open) << cell;
        const Shot back = shoot(tracer, {origin - glm::vec3(0, 2, 0), 0.0f, {0, 1, 0}, 3.0f});
        EXPECT_EQ(back.blocked, !open) << "from below, cell " << cell;
    }
}

}  // namespace

class TracerAlphaMask : public EveryTracer {};
PROBEGI_ON_EVERY_TRACER(TracerAlphaMask);

TEST_P(TracerAlphaMask, RaysPassThroughHoles) {
    expectHoles(*trace(GetParam(), Masked(AlphaMode::mask, 0.5f, 0, 255)), true, false);
}

TEST_P(TracerAlphaMask, TheCutoffItselfIsSolid) {
    expectHoles(*trace(GetParam(), Masked(AlphaMode::mask, 102.0f / 255.0f, 101, 102)), true, false);
    expectHoles(*trace(GetParam(), Masked(AlphaMode::mask, 0.3f, 60, 100)), true, false);
}

TEST_P(TracerAlphaMask, TheFactorMultipliesTheTexture) {
    expectHoles(*trace(GetParam(), Masked(AlphaMode::mask, 0.5f, 100, 200, 0.7f)), true, false);
    expectHoles(*trace(GetParam(), Masked(AlphaMode::mask, 0.5f, 100, 200, 0.5f)), true, true);
    expectHoles(*trace(GetParam(), Masked(AlphaMode::mask, 0.5f, 100, 200, 0.0f)), true, true);
}

TEST_P(TracerAlphaMask, NothingBelowTheCutoffIsAWall) {
    expectHoles(*trace(GetParam(), Masked(AlphaMode::mask, 0.3f, 100, 200)), false, false);
    expectHoles(*trace(GetParam(), Masked(AlphaMode::mask, 0.0f, 0, 255)), false, false);
}

TEST_P(TracerAlphaMask, OpaqueIgnoresAlpha) {
    expectHoles(*trace(GetParam(), Masked(AlphaMode::opaque, 0.5f, 0, 255)), false, false);
}

TEST_P(TracerAlphaMask, BlendIsAMaskAtOneHalf) {
    expectHoles(*trace(GetParam(), Masked(AlphaMode::blend, 0.99f, 127, 128)), true, false);
}

TEST_P(TracerAlphaMask, HolesInInstances) {
    Masked s(AlphaMode::mask, 0.5f, 0, 255);
    s.place(0, glm::translate(glm::mat4(1.0f), glm::vec3(20, 0, 0)));
    const auto tracer = trace(GetParam(), s);
    if (GetParam().tellsInstances) {
        EXPECT_GE(shoot(*tracer, rayAlong({-0.25f, 1, -0.75f}, {0, -1, 0})).hit.instance, 0);
    }
    expectHoles(*tracer, true, false);
}

TEST_P(TracerAlphaMask, HolesInMixedBatches) {
    const Masked scene(AlphaMode::mask, 0.5f, 0, 255);
    const auto tracer = trace(GetParam(), scene);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    std::vector<Ray> rays(3001);
    for (Ray& ray : rays) ray = {{uniform(random), 1, uniform(random)}, 0.0f, {0, -1, 0}, 3.0f};
    std::vector<Hit> hits(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    tracer->closestHits(rays, hits).value();
    tracer->occluded(rays, blocked).value();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::vec3 cell = glm::floor((rays[i].origin + 1.0f) * 2.0f);
        const bool open = int(cell.x + cell.z) % 2 == 0;
        EXPECT_EQ(hits[i].valid(), !open);
        EXPECT_EQ(blocked[i] == 0, open);
    }
}

}  // namespace probegi::test
