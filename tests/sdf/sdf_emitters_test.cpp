// Primitives that glow, as triangles for emitter sampling.
#include "sdf/sdf_emitters.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "sdf/placed_primitives.h"

namespace probegi::test {

namespace {

SdfPrimitive glowing(SdfShape shape, glm::vec3 halfSize) {
    SdfPrimitive p;
    p.shape = shape;
    p.centre = {3, 1, -2};
    p.rotation = glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.2f));
    p.halfSize = halfSize;
    p.emission = {2, 2, 2};
    return p;
}

EmitterSet emittersOf(const std::vector<SdfPrimitive>& primitives) {
    const auto placed = PlacedPrimitives::create({primitives}, {}, {});
    return probegi::emittersOf(placed->primitives(), placed->solids());
}

}  // namespace

// The divergence theorem over the faces: sum of position . normal . area / 3 is the volume, positive where all fronts
// are outside.
TEST(SdfEmitters, trianglesCloseTheBoxFrontsOutside) {
    const EmitterSet set = emittersOf({glowing(SdfShape::box, {0.5f, 0.1f, 0.3f})});
    ASSERT_EQ(set.triangles.size(), 12u);
    float volume = 0, area = 0;
    for (const EmissiveTriangle& t : set.triangles) {
        const glm::vec3 twice = glm::cross(t.edge1, t.edge2);
        volume += glm::dot(t.corner, twice) / 6.0f;
        area += 0.5f * glm::length(twice);
        EXPECT_EQ(t.material, 0);
    }
    EXPECT_NEAR(volume, 1.0f * 0.2f * 0.6f, 1e-5f);
    EXPECT_NEAR(area, 2 * (1.0f * 0.2f + 0.2f * 0.6f + 0.6f * 1.0f), 1e-5f);
    EXPECT_NEAR(set.density(0), 1 / area, 1e-5f);
}

TEST(SdfEmitters, cornersLieOnTheSurface) {
    const SdfPrimitive box = glowing(SdfShape::box, {0.5f, 0.1f, 0.3f});
    for (const EmissiveTriangle& t : emittersOf({box}).triangles)
        for (const glm::vec3 p : {t.corner, t.corner + t.edge1, t.corner + t.edge2, t.corner + 0.3f * t.edge1})
            EXPECT_NEAR(signedDistance({{box}}, p), 0.0f, 1e-5f);
}

TEST(SdfEmitters, onlyBoxesThatEmitAreInTheSet) {
    SdfPrimitive dark = glowing(SdfShape::box, {1, 1, 1});
    dark.emission = {};
    const EmitterSet set = emittersOf({dark, glowing(SdfShape::sphere, {1, 1, 1}), glowing(SdfShape::box, {1, 1, 1})});
    EXPECT_EQ(set.triangles.size(), 12u);
    EXPECT_EQ(emitterMaterial(set, 0), -1);
    EXPECT_EQ(emitterMaterial(set, 1), -1);
    EXPECT_EQ(emitterMaterial(set, 2), 2);
    EXPECT_TRUE(emittersOf({dark}).empty());
    EXPECT_TRUE(emittersOf({}).empty());
}

}  // namespace probegi::test
