#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "render/quad_scene.h"

namespace probegi::test {
namespace {

using testing::FloatNear;

constexpr float kInvPi = std::numbers::inv_pi_v<float>;

// Point on the floor at the centre of a pixel of fromAbove().
glm::vec3 floorPoint(const PictureDesc& desc, int x, int y) {
    const float h = desc.camera.position.y;
    const float metresPerPixel = 2 * h / float(desc.height);
    return {(float(x) + 0.5f - 0.5f * float(desc.width)) * metresPerPixel, 0,
            (float(y) + 0.5f - 0.5f * float(desc.height)) * metresPerPixel};
}

TEST(Direct, PointLightOnLambertFloorIsTheClosedForm) {
    const glm::vec3 albedo(0.8f, 0.5f, 0.2f), intensity(10, 20, 30), lamp(0.5f, 1.5f, -0.25f);
    const auto scene = QuadScene().floor(10, matt(albedo)).ready();
    const PictureDesc desc = fromAbove(2, 16, 8);
    const Picture picture = scene.picture({{pointLight(lamp, intensity)}, {}}, desc);
    for (int y = 0; y < desc.height; ++y)
        for (int x = 0; x < desc.width; ++x) {
            const glm::vec3 to = lamp - floorPoint(desc, x, y);
            const float d = glm::length(to);
            const glm::vec3 want = albedo * kInvPi * intensity * (to.y / d) / (d * d);
            for (int c = 0; c < 3; ++c)
                EXPECT_THAT(picture.color.at(x, y)[c], FloatNear(want[c], 1e-4f * want[c])) << x << "," << y;
        }
}

TEST(Direct, RangeAndConeLimitLights) {
    const auto scene = QuadScene().floor(10, matt(glm::vec3(0.5f))).ready();
    const PictureDesc desc = fromAbove(2, 5, 5);
    PlacedLight near = pointLight({0, 1, 0}, glm::vec3(10));
    near.range = 0.9f;
    EXPECT_EQ(scene.picture({{near}, {}}, desc).color.at(2, 2), glm::vec3(0));
    PlacedLight spot = pointLight({0, 1, 0}, glm::vec3(10));
    spot.type = LightType::spot;
    spot.direction = {0, -1, 0};
    spot.cosInner = std::cos(0.2f);
    spot.cosOuter = std::cos(0.4f);
    const Picture lit = scene.picture({{spot}, {}}, desc);
    EXPECT_NEAR(lit.color.at(2, 2).x, 5 * kInvPi, 1e-4f);
    EXPECT_EQ(lit.color.at(0, 0), glm::vec3(0));
}

TEST(Direct, SunShadowEdgeIsWhereGeometryPutsIt) {
    // A square of half side 1 at height 1, sun at 45 degrees along +X: its shadow covers x in 0..2, z in -1..1.
    const auto scene =
        QuadScene().floor(10, matt(glm::vec3(1))).quad({0, 1, 0}, {1, 0, 0}, {0, 0, -1}, 1, matt(glm::vec3(1))).ready();
    PictureDesc desc = fromAbove(0.9f, 64, 64);  // below the square, so that the floor is seen
    const Picture picture = scene.picture({{sunLight({1, -1, 0}, 2)}, {}}, desc);
    for (int y = 0; y < desc.height; ++y)
        for (int x = 0; x < desc.width; ++x) {
            const glm::vec3 p = floorPoint(desc, x, y);
            if (std::abs(p.x) < 1e-3f) continue;
            const float want = p.x > 0 ? 0.0f : 2 * kInvPi * std::sqrt(0.5f);
            EXPECT_NEAR(picture.color.at(x, y).x, want, 1e-5f) << p.x << " " << p.z;
        }
}

TEST(Direct, ManyLightsAddUp) {
    const auto scene = QuadScene().floor(10, matt(glm::vec3(0.7f))).ready();
    const PictureDesc desc = fromAbove(2, 8, 8);
    const PlacedLight a = pointLight({1, 1, 0}, {1, 2, 3}), b = sunLight({0, -1, 0.5f}, 4);
    const Picture both = scene.picture({{a, b}, {}}, desc);
    const Picture onlyA = scene.picture({{a}, {}}, desc), onlyB = scene.picture({{b}, {}}, desc);
    for (std::size_t i = 0; i < both.color.pixels.size(); ++i)
        EXPECT_NEAR(glm::length(both.color.pixels[i] - onlyA.color.pixels[i] - onlyB.color.pixels[i]), 0, 1e-6f);
}

TEST(Direct, LightBehindASurfaceDoesNotShine) {
    const auto scene = QuadScene().floor(10).ready();
    const Picture picture = scene.picture({{pointLight({0, -1, 0}, glm::vec3(10))}, {}}, fromAbove(2, 4, 4));
    for (const glm::vec3& pixel : picture.color.pixels) EXPECT_EQ(pixel, glm::vec3(0));
}

TEST(Direct, GlossyMaterialShinesMoreInTheMirrorDirection) {
    Material gloss = matt(glm::vec3(0.5f));
    gloss.roughness = 0.3f;
    const auto scene = QuadScene().floor(10, gloss).ready();
    PictureDesc desc = fromAbove(2, 33, 33);
    const Lighting lighting{{sunLight({0, -1, 0}, 1)}, {}};
    const Picture matte = scene.picture(lighting, desc);
    desc.diffuseOnly = false;
    const Picture glossy = scene.picture(lighting, desc);
    EXPECT_GT(glossy.color.at(16, 16).x, 1.5f * matte.color.at(16, 16).x);  // the mirror direction
    EXPECT_LT(glossy.color.at(0, 0).x, 1.01f * matte.color.at(0, 0).x);     // far from it
}

TEST(Direct, NoAcneFarFromTheOrigin) {
    // At a kilometre, float coordinates are 60 micrometres apart: shadow rays must not hit their own surface.
    const auto scene = QuadScene().quad({1000, 500, -800}, {1, 0, 0}, {0, 0, -1}, 5, matt(glm::vec3(1))).ready();
    PictureDesc desc = fromAbove(2, 32, 32);
    desc.camera.position += glm::vec3(1000, 500, -800);
    const Picture picture = scene.picture({{sunLight({1, -0.1f, 0.3f}, 1)}, {}}, desc);
    for (const glm::vec3& pixel : picture.color.pixels) EXPECT_GT(pixel.x, 0);
}

}  // namespace
}  // namespace probegi::test
