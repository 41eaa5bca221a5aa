// Pictures with contact light: closed forms, what must not change, and its history.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "probegi/builtin_scenes.h"
#include "render/picture_runner.h"
#include "render/quad_scene.h"
#include "support/field_setup.h"

namespace probegi::test {
namespace {

PictureDesc withContact(PictureDesc desc, float reach = 1.0f) {
    desc.contact = true;
    desc.contactReach = reach;
    return desc;
}

PlacedCamera cameraAt(glm::vec3 from, glm::vec3 at) {
    PlacedCamera camera;
    camera.position = from;
    camera.forward = glm::normalize(at - from);
    const glm::vec3 right = glm::normalize(glm::cross(camera.forward, glm::vec3(0, 1, 0)));
    camera.up = glm::cross(right, camera.forward);
    camera.yfov = 1.0f;
    return camera;
}

// A floor that ends at a wall at z = 0, 8 m wide, and their corner from nearby.
QuadScene corner(Material material = matt(glm::vec3(0.6f))) {
    QuadScene scene;
    scene.quad({0, 0, 4}, {1, 0, 0}, {0, 0, -1}, 4, material).quad({0, 4, 0}, {1, 0, 0}, {0, 1, 0}, 4, material);
    return scene;
}

PictureDesc ofCorner(int width, int height) {
    PictureDesc desc = fromAbove(1, width, height);
    desc.camera = cameraAt({0, 1.5f, 2.5f}, {0, 0.2f, 0});
    return desc;
}

// Of a scene of 8 m: metres from metres.
float reachOf(float metres) {
    return metres / (0.125f * std::sqrt(3.0f) * 8.0f);
}

Field litBySky(const QuadScene::Ready& scene, const Lighting& lighting, glm::vec3 origin = {-3, -1, -3}) {
    FieldSetup desc;
    desc.volumes = {{origin, glm::vec3(1), {7, 5, 7}}};
    desc.raysPerProbe = 128;
    Field field = Field::create(scene.context, desc, desc).value();
    for (int i = 0; i < 4; ++i) field.update(*scene.tracer, lighting).value();
    return field;
}

TEST(ContactPicture, aFlatFloorIsUnchangedToTheBit) {
    Lighting sky;
    sky.sky.radiance = {0.5f, 1, 2};
    for (const float half : {100.0f, 1.3f}) {  // all over the picture, and with the sky around it
        const auto scene = QuadScene().floor(half, matt(glm::vec3(0.7f))).ready();
        const Field field = litBySky(scene, sky);
        for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {40, 1}, {2, 3}, {65, 37}})
            for (const bool oblique : {false, true}) {
                PictureDesc desc = fromAbove(2, width, height);
                if (oblique) desc.camera = cameraAt({0.3f, 0.8f, 1.9f}, {0, 0, 0});
                const Picture off = scene.picture(sky, desc, &field),
                              on = scene.picture(sky, withContact(desc), &field);
                EXPECT_EQ(on.color.pixels, off.color.pixels);
                EXPECT_EQ(on.irradiance.pixels, off.irradiance.pixels);
                for (std::size_t i = 0; i < on.openness.pixels.size(); ++i)
                    ASSERT_EQ(on.openness.pixels[i].x, on.depth.pixels[i].x > 0 ? 1.0f : 0.0f);
            }
    }
}

TEST(ContactPicture, withoutItThereAreNoLayers) {
    const Picture p = corner().ready().picture({}, ofCorner(16, 9));
    EXPECT_EQ(p.contact.width, 0);
    EXPECT_EQ(p.openness.width, 0);
}

// The share that a wall takes of a floor's directions, `distance` away: of each azimuth the horizon, which what is far
// raises part of the way. Without the reach it is a half next to the wall.
double wallShare(double distance, double reach) {
    constexpr int kAzimuths = 200, kHeights = 400;
    double sum = 0;
    for (int i = 0; i < kAzimuths; ++i) {
        const double along = distance / std::cos((i + 0.5) / kAzimuths * 1.57079633);
        double horizon = 0;
        for (int j = 0; j < kHeights; ++j) {
            const double up = std::tan((j + 0.5) / kHeights * 1.57079633), far = along * std::sqrt(1 + up * up);
            horizon = std::max(horizon, std::atan(up) * double(kernels::contactNearness(float(far), float(reach))));
        }
        sum += std::sin(horizon) * std::sin(horizon);
    }
    return 0.5 * sum / kAzimuths;
}

// Next to a wall half of a floor's directions are taken; more than the reach away none.
TEST(ContactPicture, aRightAngleTakesHalf) {
    EXPECT_NEAR(wallShare(1e-3, 1.0), 0.5, 0.02);
    const auto scene = corner().ready();
    const PictureDesc desc = withContact(ofCorner(240, 180), reachOf(1.0f));
    const Picture p = scene.picture({}, desc);
    const kernels::PinholeCamera camera = kernels::makePinhole(
        desc.camera.position, desc.camera.forward, desc.camera.up, desc.camera.yfov, desc.width, desc.height);
    int close = 0, away = 0;
    for (int y = 0; y < desc.height; ++y) {
        const int x = desc.width / 2;
        if (p.normal.at(x, y).y < 0.9f) continue;
        const glm::vec3 place = camera.origin + kernels::subSampleDirection(camera, x, y, 0, 1) * p.depth.at(x, y).x;
        const float open = p.openness.at(x, y).x;
        // A blur of two pixels and few steps: closer there are none at heights that matter.
        if (place.z > 0.05f) {
            EXPECT_NEAR(open, 1 - wallShare(double(place.z), 1.0), 0.05) << place.z;
        }
        close += open < 0.75f ? 1 : 0;
        if (place.z > 1.02f) {
            EXPECT_EQ(open, 1.0f) << place.z;
            ++away;
        }
    }
    EXPECT_GE(close, 2);
    EXPECT_GT(away, 10);
}

// Without probes and lamps, all light is the wall's own: half of a floor's directions see it.
TEST(ContactPicture, aWallThatGlowsLightsTheFloor) {
    Material glow = matt(glm::vec3(0.0f));
    glow.emission = {1, 2, 3};
    QuadScene quads;
    quads.quad({0, 0, 4}, {1, 0, 0}, {0, 0, -1}, 4, matt(glm::vec3(0.5f)))
        .quad({0, 4, 0}, {1, 0, 0}, {0, 1, 0}, 4, glow);
    const Picture p = quads.ready().picture({}, withContact(ofCorner(160, 120), reachOf(1.5f)));
    float most = 0;
    for (std::size_t i = 0; i < p.irradiance.pixels.size(); ++i) {
        const glm::vec3 e = p.irradiance.pixels[i];
        EXPECT_NEAR(e.y, 2 * e.x, 1e-3f);
        if (p.normal.pixels[i].y > 0.9f) most = std::max(most, e.x);
        // Before the blur it is the share of a radiance of 1, where the wall is in the picture.
        EXPECT_LE(e.x, 3.1416f * 0.56f);
    }
    EXPECT_GT(most, 3.1416f * 0.28f);
}

// A closed room of uniform light has the same light in every corner.
TEST(ContactPicture, aFurnaceStaysAFurnace) {
    const Context context = Context::create({.threads = 2}).value();
    for (const float albedo : {0.0f, 0.8f}) {
        const Scene scene = makeBuiltinScene("furnace", {.albedo = albedo}).value();
        const ScenePose pose = poseAt(scene);
        const auto tracer = makeEmbreeTracer(context, scene, pose).value();
        const Lighting lighting{pose.lights, scene.sky};
        FieldSetup setup;
        const glm::vec3 size = pose.bounds.size();
        setup.volumes = {{pose.bounds.lower - 0.1f * size, size * 0.3f, glm::ivec3(5)}};
        Field field = Field::create(context, setup, setup).value();
        field.converge(*tracer, lighting, 0.002f, 200).value();
        PictureDesc desc{.camera = pose.cameras.at(0), .width = 96, .height = 64, .samplesPerAxis = 1};
        const Picture off = renderPicture(context, *tracer, lighting, &field, desc).value().picture;
        const Picture on = renderPicture(context, *tracer, lighting, &field, withContact(desc, 2.0f)).value().picture;
        const float exact = 3.14159265f / (1 - albedo);
        int taken = 0;
        for (std::size_t i = 0; i < on.irradiance.pixels.size(); ++i) {
            EXPECT_NEAR(on.irradiance.pixels[i].x, off.irradiance.pixels[i].x, 0.004f * exact);
            EXPECT_NEAR(on.irradiance.pixels[i].x, exact, 0.01f * exact);
            taken += on.openness.pixels[i].x < 0.8f ? 1 : 0;
        }
        EXPECT_GT(taken, 300);  // there are corners in the picture
    }
}

// A lid over the floor: what is below it and what is beside it, and a camera that looks at its top.
TEST(ContactPicture, manyPlanesAreTheirMean) {
    const auto scene = corner().ready(2);
    Lighting lighting{{pointLight({1, 2, 2}, glm::vec3(5))}, {}};
    PictureDesc desc = withContact(ofCorner(80, 60), reachOf(1.0f));
    const Picture one = scene.picture(lighting, desc);
    desc.samplesPerAxis = 3;
    const Picture nine = scene.picture(lighting, desc);
    double difference = 0, light = 0;
    for (std::size_t i = 0; i < one.contact.pixels.size(); ++i) {
        difference += double(nine.contact.pixels[i].x) - double(one.contact.pixels[i].x);
        light += double(one.contact.pixels[i].x);
        EXPECT_LE(nine.openness.pixels[i].x, 1.0f);
        EXPECT_NEAR(nine.openness.pixels[i].x, one.openness.pixels[i].x, 0.25f);
    }
    EXPECT_GT(light, 10.0);
    EXPECT_LT(std::abs(difference), 0.05 * light);
}

TEST(ContactPicture, doesNotDependOnThreads) {
    Lighting lighting{{pointLight({1, 2, 2}, glm::vec3(5))}, {}};
    const PictureDesc desc = withContact(ofCorner(150, 90), reachOf(1.0f));
    const Picture one = corner().ready(1).picture(lighting, desc), three = corner().ready(3).picture(lighting, desc);
    EXPECT_EQ(one.color.pixels, three.color.pixels);
    EXPECT_EQ(one.openness.pixels, three.openness.pixels);
}

// A picture in bands differs only where a search would cross a seam.
TEST(ContactPicture, bandsAreThePictureUpToTheirSeams) {
    const auto scene = corner().ready();
    Lighting lighting{{pointLight({1, 2, 2}, glm::vec3(5))}, {}};
    const PictureDesc desc = withContact(ofCorner(60, 90), reachOf(0.15f));
    const auto draw = [&](std::size_t framePixels) {
        return runPicture(scene.context, {*scene.tracer, lighting, nullptr, desc}, picturePasses(desc), framePixels)
            .value()
            .picture;
    };
    constexpr int kRows = 30, kSearch = 10;  // pixels: 0.15 m are at most 8
    const Picture whole = draw(kFramePixels), bands = draw(60 * kRows);
    int taken = 0, equal = 0;
    for (int y = 0; y < desc.height; ++y)
        for (int x = 0; x < desc.width; ++x) {
            const int inBand = y % kRows;
            if (inBand < kSearch || inBand >= kRows - kSearch) continue;
            EXPECT_EQ(bands.openness.at(x, y), whole.openness.at(x, y)) << x << ' ' << y;
            EXPECT_EQ(bands.color.at(x, y), whole.color.at(x, y)) << x << ' ' << y;
            ++equal;
        }
    for (const glm::vec3& open : bands.openness.pixels) taken += open.x < 1 ? 1 : 0;
    EXPECT_GT(equal, 1000);
    EXPECT_GT(taken, 50);
}

TEST(ContactPicture, glossyLightGoesBesideIt) {
    Material metal = matt(glm::vec3(0.6f));
    metal.metallic = 0.5f;
    metal.roughness = 0.3f;
    const auto scene = corner(metal).ready();
    Lighting lighting{{pointLight({1, 2, 2}, glm::vec3(5))}, {}};
    lighting.sky.radiance = glm::vec3(0.5f);
    const Field field = litBySky(scene, lighting, {-3, -0.5f, -0.5f});
    PictureDesc desc = withContact(ofCorner(61, 47));
    desc.diffuseOnly = false;
    const Picture matt = scene.picture(lighting, desc, &field);
    desc.glossy = Glossy::field;
    const Picture both = scene.picture(lighting, desc, &field);
    desc.contact = false;
    const Picture glossyOnly = scene.picture(lighting, desc, &field);
    EXPECT_EQ(both.irradiance.pixels, matt.irradiance.pixels);
    EXPECT_EQ(both.contact.pixels, matt.contact.pixels);
    EXPECT_EQ(both.glossy.pixels, glossyOnly.glossy.pixels);
    EXPECT_NE(both.irradiance.pixels, glossyOnly.irradiance.pixels);
    for (std::size_t i = 0; i < both.color.pixels.size(); ++i)
        if (both.depth.pixels[i].x > 0) {
            EXPECT_LT(glm::distance(both.color.pixels[i], both.direct.pixels[i] + both.indirect.pixels[i]), 1e-4f);
        }
}

TEST(ContactPicture, reachesOutOfRangeAreRefused) {
    const auto scene = corner().ready();
    for (const float reach : {0.0f, -1.0f, 4.5f, std::nanf("")}) {
        const auto refused =
            renderPicture(scene.context, *scene.tracer, {}, nullptr, withContact(ofCorner(8, 8), reach));
        ASSERT_FALSE(refused) << reach;
        EXPECT_EQ(refused.error().code, ErrorCode::invalidArgument);
        EXPECT_THAT(refused.error().message, ::testing::HasSubstr("contactReach"));
    }
}

double noiseOf(const HdrImage& image, const HdrImage& mean) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const double d = double(image.pixels[i].x) - double(mean.pixels[i].x);
        sum += d * d;
    }
    return std::sqrt(sum / double(image.pixels.size()));
}

HdrImage meanOf(const std::vector<HdrImage>& images) {
    HdrImage mean(images[0].width, images[0].height);
    for (const HdrImage& image : images)
        for (std::size_t i = 0; i < image.pixels.size(); ++i) mean.pixels[i] += image.pixels[i] / float(images.size());
    return mean;
}

TEST(ContactHistoryPicture, noiseFallsFromPictureToPicture) {
    const auto scene = corner().ready(2);
    PictureDesc desc = withContact(ofCorner(120, 90), reachOf(1.0f));
    std::vector<HdrImage> kept;
    ContactHistory history;
    desc.contactHistory = &history;
    for (int i = 0; i < 24; ++i) kept.push_back(scene.picture({}, desc).openness);
    const HdrImage mean = meanOf({kept.begin() + 12, kept.end()});
    EXPECT_LT(noiseOf(kept[20], mean), 0.5 * noiseOf(kept[0], mean));
    // By itself again.
    history.forget();
    EXPECT_GT(noiseOf(scene.picture({}, desc).openness, mean), 0.7 * noiseOf(kept[0], mean));
}

// A moving camera takes no shadow along: the floor far from the wall stays free of it, and the corner is as in a
// picture by itself.
TEST(ContactHistoryPicture, aMovingCameraLeavesNoTrail) {
    const auto scene = corner().ready(2);
    PictureDesc desc = withContact(ofCorner(120, 90), reachOf(1.0f));
    ContactHistory history;
    desc.contactHistory = &history;
    Picture last;
    for (int i = 0; i < 12; ++i) {
        desc.camera = cameraAt({-0.6f + 0.1f * float(i), 1.5f, 2.5f + 0.05f * float(i)}, {0.05f * float(i), 0.2f, 0});
        last = scene.picture({}, desc);
    }
    desc.contactHistory = nullptr;
    const Picture alone = scene.picture({}, desc);
    double difference = 0, shadow = 0;
    for (std::size_t i = 0; i < alone.openness.pixels.size(); ++i) {
        difference += double(last.openness.pixels[i].x) - double(alone.openness.pixels[i].x);
        shadow += 1.0 - double(alone.openness.pixels[i].x);
        if (alone.openness.pixels[i].x == 1.0f) {
            EXPECT_GT(last.openness.pixels[i].x, 0.9f);
        }
    }
    EXPECT_GT(shadow, 150);
    EXPECT_LT(std::abs(difference), 0.03 * shadow);
}

TEST(ContactHistoryPicture, anotherSizeBeginsAnew) {
    const auto scene = corner().ready();
    ContactHistory history;
    PictureDesc desc = withContact(ofCorner(60, 40), reachOf(1.0f));
    desc.contactHistory = &history;
    scene.picture({}, desc);
    desc.width = 48;
    const Picture p = scene.picture({}, desc);
    EXPECT_EQ(p.openness.width, 48);
    ContactHistory moved = std::move(history);
    desc.contactHistory = &moved;
    EXPECT_EQ(scene.picture({}, desc).openness.width, 48);
}

}  // namespace
}  // namespace probegi::test
