// Pictures with glossy light: closed forms, mirror images by a mirrored camera, and the path tracer.
#include <gmock/gmock.h>

#include <cmath>

#include "kernels/screen/glossy_ray.h"
#include "kernels/screen/pinhole.h"
#include "render/quad_scene.h"
#include "support/field_setup.h"

namespace probegi::test {
namespace {

Material metal(glm::vec3 reflectance, float roughness) {
    Material material = matt(reflectance);
    material.metallic = 1.0f;
    material.roughness = roughness;
    return material;
}

PictureDesc glossyDesc(PictureDesc desc, Glossy glossy = Glossy::first) {
    desc.diffuseOnly = false;
    desc.glossy = glossy;
    return desc;
}

// What the metal floor seen in fromAbove() reflects of uniform light.
glm::vec3 reflectance(const PictureDesc& desc, const Material& material, int x, int y) {
    const kernels::PinholeCamera camera = kernels::makePinhole(
        desc.camera.position, desc.camera.forward, desc.camera.up, desc.camera.yfov, desc.width, desc.height);
    const glm::vec3 view = kernels::subSampleDirection(camera, x, y, 0, 1);
    const kernels::Bsdf bsdf =
        kernels::makeBsdf(glm::vec3(material.baseColor), material.metallic, material.roughness, false);
    return kernels::lobeAlbedo(bsdf, -view.y).specular;
}

// Uniform light from everywhere comes back as the lobe's albedo says, for a mirror all of it: to the rounding, since a
// mean of equal rays is that ray. All sizes, cut blocks included.
TEST(GlossyPicture, aFurnaceIsTheLobesAlbedo) {
    Lighting furnace;
    furnace.sky.radiance = {2, 1, 0.5f};
    for (const float roughness : {0.0f, 0.2f, 0.5f}) {
        const Material white = metal(glm::vec3(1.0f), roughness);
        const auto scene = QuadScene().floor(100, white).ready();
        for (const auto& [width, height] : {std::pair{1, 1}, {1, 2}, {5, 1}, {7, 9}, {70, 33}}) {
            const PictureDesc desc = glossyDesc(fromAbove(2, width, height));
            const Picture p = scene.picture(furnace, desc);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const glm::vec3 wanted = furnace.sky.radiance * reflectance(desc, white, x, y);
                    ASSERT_LT(glm::distance(p.color.at(x, y), wanted), 1e-4f) << roughness << ' ' << x << ' ' << y;
                    if (roughness == 0.0f) {
                        ASSERT_NEAR(p.color.at(x, y).x, 2.0f, 0.026f);
                    }
                }
        }
    }
}

// A mirror on the floor, and above it a board with a lamp, both with a point light on them.
QuadScene underBoards(bool withMirror) {
    Material lamp = matt({0.3f, 0.6f, 0.2f});
    lamp.emission = {3, 1, 2};
    QuadScene scene;
    scene.quad({0.2f, 3, 0}, {1, 0, 0}, {0, 0, 1}, 1.3f, matt({0.7f, 0.4f, 0.2f}))
        .quad({-0.7f, 2.2f, 0.3f}, {1, 0, 0}, {0, 0, 1}, 0.4f, lamp);
    if (withMirror) scene.floor(50, metal(glm::vec3(0.9f), 0.0f));
    return scene;
}

// Where a pixel has a ray of its own, a mirror shows what a camera behind it sees.
TEST(GlossyPicture, aMirrorShowsWhatTheMirroredCameraSees) {
    Lighting lighting{{pointLight({0.4f, 1.0f, 0.1f}, {4, 5, 6})}, {}};
    lighting.sky.radiance = {0.2f, 0.3f, 0.7f};
    PictureDesc desc = glossyDesc(fromAbove(1, 60, 44));
    desc.camera = lookAt({0.3f, 1.5f, 1.2f}, {0, 0, 0});
    const Picture seen = underBoards(true).ready().picture(lighting, desc);
    PictureDesc mirrored = desc;
    for (glm::vec3* v : {&mirrored.camera.position, &mirrored.camera.forward, &mirrored.camera.up}) v->y = -v->y;
    const Picture wanted = underBoards(false).ready().picture(lighting, mirrored);
    int compared = 0;
    float brightest = 0;
    for (int y = 0; y < desc.height; y += 2)
        for (int x = 0; x < desc.width; x += 2) {
            if (seen.albedo.at(x, y) != glm::vec3(0.9f)) continue;
            const glm::vec3 image = wanted.color.at(desc.width - 1 - x, y);
            const glm::vec3 own = seen.glossy.at(x, y);
            // The reflectance, and its fit.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(own[c], 0.9f * image[c], 0.035f * image[c] + 1e-4f) << x << ' ' << y;
            brightest = std::max(brightest, image.x);
            ++compared;
        }
    EXPECT_GT(compared, 400);
    EXPECT_GT(brightest, 2.9f);  // the lamp is among them
}

Field skyField(const QuadScene::Ready& scene, const Lighting& lighting) {
    FieldSetup desc;
    desc.volumes = {{{-3, -1, -3}, glm::vec3(1), {7, 5, 7}}};
    desc.raysPerProbe = 128;
    Field field = Field::create(scene.context, desc, desc).value();
    for (int i = 0; i < 4; ++i) field.update(*scene.tracer, lighting).value();
    return field;
}

TEST(GlossyPicture, metalsHaveNoDiffuseLight) {
    Lighting lighting;
    lighting.sky.radiance = glm::vec3(1.0f);
    const auto scene = QuadScene().floor(50, metal({0.8f, 0.5f, 0.1f}, 0.3f)).ready();
    const Field field = skyField(scene, lighting);
    for (const Glossy glossy : {Glossy::first, Glossy::field}) {
        const Picture p = scene.picture(lighting, glossyDesc(fromAbove(2, 21, 15), glossy), &field);
        for (std::size_t i = 0; i < p.indirect.pixels.size(); ++i) {
            ASSERT_GT(p.irradiance.pixels[i].x, 1.0f);
            ASSERT_EQ(p.indirect.pixels[i], p.glossy.pixels[i]);
        }
    }
}

// Rough surfaces ask the field: under a sky of 1 its E / pi is 1. Dielectrics keep the rest for their diffuse lobe.
TEST(GlossyPicture, roughSurfacesHaveTheFieldsLight) {
    Lighting lighting;
    lighting.sky.radiance = glm::vec3(1.0f);
    Material rough = matt(glm::vec3(0.5f));
    rough.roughness = 0.9f;
    const auto scene = QuadScene().floor(50, rough).ready();
    const Field field = skyField(scene, lighting);
    const PictureDesc desc = glossyDesc(fromAbove(2, 9, 9));
    const Picture p = scene.picture(lighting, desc, &field);
    const kernels::LobeAlbedo albedo = kernels::lobeAlbedo(kernels::makeBsdf(glm::vec3(0.5f), 0, 0.9f, false), 1.0f);
    EXPECT_NEAR(p.glossy.at(4, 4).x, albedo.specular.x, 0.03f * albedo.specular.x);
    EXPECT_NEAR(p.indirect.at(4, 4).x, albedo.specular.x + albedo.diffuse.x, 0.02f);
    const Picture without = scene.picture(lighting, desc);
    for (const glm::vec3& light : without.glossy.pixels) ASSERT_EQ(light, glm::vec3(0));
}

// Between two mirrors, what rays hit has light of its own only with Glossy::field.
TEST(GlossyPicture, secondReflectionsAreTheFields) {
    Lighting lighting;
    lighting.sky.radiance = glm::vec3(1.0f);
    const auto scene = QuadScene()
                           .floor(50, metal(glm::vec3(1.0f), 0.0f))
                           .quad({0, 4, 0}, {1, 0, 0}, {0, 0, 1}, 0.8f, metal(glm::vec3(1.0f), 0.0f))
                           .ready();
    const Field field = skyField(scene, lighting);
    const PictureDesc desc = fromAbove(2, 21, 21);
    const Picture first = scene.picture(lighting, glossyDesc(desc, Glossy::first), &field);
    const Picture second = scene.picture(lighting, glossyDesc(desc, Glossy::field), &field);
    EXPECT_EQ(first.glossy.at(10, 10), glm::vec3(0));
    EXPECT_GT(second.glossy.at(10, 10).x, 0.5f);
    EXPECT_EQ(first.glossy.at(0, 0), second.glossy.at(0, 0));  // the sky
}

TEST(GlossyPicture, offAndDiffuseOnlyHaveNone) {
    Lighting lighting{{pointLight({0, 2, 0}, glm::vec3(5))}, {}};
    lighting.sky.radiance = glm::vec3(1.0f);
    const auto scene = QuadScene().floor(50, metal({0.8f, 0.5f, 0.1f}, 0.3f)).ready();
    const Field field = skyField(scene, lighting);
    const PictureDesc plain = fromAbove(2, 20, 10);
    PictureDesc diffuse = plain;
    diffuse.glossy = Glossy::field;
    const Picture p = scene.picture(lighting, plain, &field), d = scene.picture(lighting, diffuse, &field);
    EXPECT_EQ(p.color.pixels, d.color.pixels);
    EXPECT_EQ(p.indirect.pixels, d.indirect.pixels);
    EXPECT_TRUE(p.glossy.pixels.empty());
    EXPECT_TRUE(d.glossy.pixels.empty());
}

TEST(GlossyPicture, valuesThatAreNoneAreRefused) {
    const auto scene = QuadScene().floor(5).ready();
    const auto refused =
        renderPicture(scene.context, *scene.tracer, {}, nullptr, glossyDesc(fromAbove(1, 2, 2), Glossy(3)));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalidArgument);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("glossy"));
}

TEST(GlossyPicture, isTheSameWithOneThreadAndWithMany) {
    Lighting lighting{{pointLight({0.4f, 1.0f, 0.1f}, {4, 5, 6})}, {}};
    PictureDesc desc = glossyDesc(fromAbove(1, 131, 70));
    desc.samplesPerAxis = 2;
    const Picture one = underBoards(true).ready(1).picture(lighting, desc);
    const Picture many = underBoards(true).ready(3).picture(lighting, desc);
    EXPECT_EQ(one.glossy.pixels, many.glossy.pixels);
}

}  // namespace
}  // namespace probegi::test
