#include <gmock/gmock.h>

#include <cmath>

#include "render/quad_scene.h"
#include "support/field_setup.h"

namespace probegi::test {
namespace {

std::vector<const HdrImage*> layers(const Picture& p) {
    return {&p.color, &p.direct, &p.indirect, &p.irradiance, &p.albedo, &p.normal, &p.depth};
}

// A floor, a wall and a lamp under a blue sky.
QuadScene corner() {
    Material lamp = matt(glm::vec3(0.2f));
    lamp.emission = {3, 2, 1};
    return QuadScene()
        .floor(2, matt({0.6f, 0.5f, 0.4f}))
        .quad({0, 1, -1}, {1, 0, 0}, {0, 1, 0}, 1, matt({0.2f, 0.7f, 0.2f}))
        .quad({0.5f, 0.5f, -0.9f}, {1, 0, 0}, {0, 1, 0}, 0.2f, lamp);
}

Lighting cornerLight() {
    Lighting lighting{{pointLight({0.5f, 1.5f, 1}, {5, 5, 5}), sunLight({-1, -2, -1}, 3)}, {}};
    lighting.sky.radiance = {0.2f, 0.4f, 0.8f};
    return lighting;
}

PictureDesc cornerDesc() {
    PictureDesc desc;
    desc.camera = lookAt({0.3f, 1, 3}, {0, 0.8f, 0});
    desc.width = 70;  // wider than a tile, and not a multiple of one
    desc.height = 41;
    return desc;
}

Field litField(const QuadScene::Ready& scene, const Lighting& lighting) {
    FieldSetup desc;
    desc.volumes = {{{-3, -1, -3}, glm::vec3(1), {7, 5, 7}}};
    desc.raysPerProbe = 64;
    Field field = Field::create(scene.context, desc, desc).value();
    for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(field.update(*scene.tracer, lighting));
    return field;
}

TEST(Picture, ColorIsDirectPlusIndirectOnSurfacesAndSkyElsewhere) {
    const auto scene = corner().ready();
    const Lighting lighting = cornerLight();
    const Field field = litField(scene, lighting);
    PictureDesc desc = cornerDesc();
    desc.samplesPerAxis = 1;
    const Picture p = scene.picture(lighting, desc, &field);
    int surfaces = 0, sky = 0;
    double indirect = 0;
    for (std::size_t i = 0; i < p.color.pixels.size(); ++i) {
        const bool hit = p.depth.pixels[i].x > 0;
        EXPECT_EQ(p.color.pixels[i], hit ? p.direct.pixels[i] + p.indirect.pixels[i] : lighting.sky.radiance);
        if (!hit) {
            EXPECT_EQ(p.irradiance.pixels[i], glm::vec3(0));
        }
        indirect += p.indirect.pixels[i].x;
        (hit ? surfaces : sky) += 1;
    }
    EXPECT_GT(surfaces, 100);
    EXPECT_GT(sky, 100);
    EXPECT_GT(indirect, 0);
}

TEST(Picture, IndirectIsAlbedoTimesIrradianceOverPi) {
    const auto scene = corner().ready();
    const Lighting lighting = cornerLight();
    const Field field = litField(scene, lighting);
    PictureDesc desc = cornerDesc();
    desc.samplesPerAxis = 1;
    const Picture p = scene.picture(lighting, desc, &field);
    for (std::size_t i = 0; i < p.color.pixels.size(); ++i) {
        const glm::vec3 want = p.albedo.pixels[i] * p.irradiance.pixels[i] / 3.14159265f;
        EXPECT_NEAR(glm::length(p.indirect.pixels[i] - want), 0, 1e-6f);
    }
}

TEST(Picture, WithoutFieldThereIsNoIndirectLight) {
    const auto scene = corner().ready();
    const Picture p = scene.picture(cornerLight(), cornerDesc());
    for (const glm::vec3& pixel : p.indirect.pixels) EXPECT_EQ(pixel, glm::vec3(0));
}

TEST(Picture, EmissionIsSeenOnceAndAddedNotMultiplied) {
    Material lamp = matt(glm::vec3(0.5f));
    lamp.emission = {3, 2, 1};
    const auto scene = QuadScene().floor(5, lamp).ready();
    const Picture p = scene.picture({}, fromAbove(1, 4, 4));
    for (const glm::vec3& pixel : p.color.pixels) EXPECT_EQ(pixel, glm::vec3(3, 2, 1));
}

TEST(Picture, BackOfASingleSidedSurfaceIsBlack) {
    Material lamp = matt(glm::vec3(0.5f));
    lamp.emission = {3, 2, 1};
    const auto scene = QuadScene().quad({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 5, lamp).ready();  // faces down
    const Picture p = scene.picture(cornerLight(), fromAbove(1, 4, 4));
    for (const glm::vec3& pixel : p.color.pixels) EXPECT_EQ(pixel, glm::vec3(0));
}

TEST(Picture, LayersAreFiniteAndNotNegative) {
    const auto scene = corner().ready();
    const Lighting lighting = cornerLight();
    const Field field = litField(scene, lighting);
    const Picture p = scene.picture(lighting, cornerDesc(), &field);
    for (const HdrImage* layer : layers(p)) {
        EXPECT_EQ(layer->pixels.size(), std::size_t(70 * 41));
        for (const glm::vec3& v : layer->pixels) {
            EXPECT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
            if (layer != &p.normal) {
                EXPECT_TRUE(v.x >= 0 && v.y >= 0 && v.z >= 0);
            }
        }
    }
}

TEST(Picture, SameForAnyNumberOfThreads) {
    const Lighting lighting = cornerLight();
    const auto one = corner().ready(1), three = corner().ready(3);
    const Field fieldOne = litField(one, lighting), fieldThree = litField(three, lighting);
    const Picture a = one.picture(lighting, cornerDesc(), &fieldOne);
    const Picture b = three.picture(lighting, cornerDesc(), &fieldThree);
    for (std::size_t layer = 0; layer < layers(a).size(); ++layer)
        EXPECT_TRUE(layers(a)[layer]->pixels == layers(b)[layer]->pixels) << "layer " << layer;
}

TEST(Picture, TheSkysTextureIsTheRightWayUp) {
    Lighting lighting;
    lighting.sky.radiance = glm::vec3(2);
    lighting.sky.image = HdrImage(4, 2, {0, 0, 1});  // lower half blue
    for (int x = 0; x < 4; ++x) lighting.sky.image.at(x, 0) = {1, 0, 0};
    const auto scene = QuadScene().floor(0.01f).ready();
    PictureDesc desc = cornerDesc();
    desc.camera = lookAt({0, 5, 0}, {0, 5, -1}, 2.0f);
    const Picture p = scene.picture(lighting, desc);
    EXPECT_GT(p.color.at(35, 0).x, 1.0f);
    EXPECT_LT(p.color.at(35, 0).z, 1.0f);
    EXPECT_GT(p.color.at(35, 40).z, 1.0f);
}

TEST(Picture, DepthAndNormalOfAFloor) {
    const auto scene = QuadScene().floor(50).ready();
    const PictureDesc desc = fromAbove(2, 9, 9);
    const Picture p = scene.picture({}, desc);
    EXPECT_NEAR(p.depth.at(4, 4).x, 2, 1e-5f);
    EXPECT_NEAR(p.depth.at(8, 4).x, 2 * std::sqrt(1 + std::pow(8.0f / 9, 2.0f)), 1e-4f);
    for (const glm::vec3& n : p.normal.pixels) EXPECT_NEAR(glm::length(n - glm::vec3(0, 1, 0)), 0, 1e-6f);
}

TEST(Picture, SupersamplingIsTheMeanOfItsRays) {
    const auto scene = corner().ready();
    const Lighting lighting = cornerLight();
    PictureDesc coarse = cornerDesc(), fine = cornerDesc();
    coarse.samplesPerAxis = 4;
    fine.samplesPerAxis = 1;
    fine.width *= 4;
    fine.height *= 4;
    const Picture a = scene.picture(lighting, coarse), b = scene.picture(lighting, fine);
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x) {
            glm::vec3 mean(0);
            for (int s = 0; s < 16; ++s) mean += b.color.at(4 * x + s % 4, 4 * y + s / 4) / 16.0f;
            // Equal except for rays that pass an edge within rounding.
            EXPECT_NEAR(glm::length(a.color.at(x, y) - mean), 0, 0.3f);
        }
}

TEST(Picture, OnePixel) {
    const auto scene = QuadScene().floor(5, matt(glm::vec3(1))).ready();
    PictureDesc desc = fromAbove(1, 1, 1);
    EXPECT_NEAR(scene.picture({{sunLight({0, -1, 0}, 3.14159265f)}, {}}, desc).color.at(0, 0).x, 1, 1e-5f);
}

TEST(Picture, SizesOutOfRangeAreRefused) {
    const auto scene = QuadScene().floor(5).ready();
    const auto refused = [&](int width, int height, int samples) {
        PictureDesc desc = fromAbove(1, width, height);
        desc.samplesPerAxis = samples;
        const auto result = renderPicture(scene.context, *scene.tracer, {}, nullptr, desc);
        return !result && result.error().code == ErrorCode::invalidArgument && !result.error().message.empty();
    };
    EXPECT_TRUE(refused(0, 4, 1));
    EXPECT_TRUE(refused(4, -1, 1));
    EXPECT_TRUE(refused(16385, 4, 1));
    EXPECT_TRUE(refused(4, 4, 0));
    EXPECT_TRUE(refused(4, 4, 9));
    EXPECT_FALSE(refused(4, 4, 8));
}

TEST(Picture, ACancelledRenderingIsAnError) {
    const auto scene = corner().ready();
    ContextDesc desc;
    desc.progress = [](const ProgressReport&) { return false; };
    const Context context = Context::create(desc).value();
    PictureDesc large = cornerDesc();
    large.width = large.height = 2000;
    const auto result = renderPicture(context, *scene.tracer, cornerLight(), nullptr, large);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace probegi::test
