// Textures in pictures: a checkerboard far away is its mean, a near one shows its squares.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/quad_scene.h"

namespace probegi::test {
namespace {

constexpr int kSquares = 1024;

/// A floor of 64 x 64 m with black and white squares of 1/16 m.
Scene chessFloor() {
    Scene scene;
    TextureImage image{kSquares, kSquares, {}, "checkerboard"};
    for (int y = 0; y < kSquares; ++y)
        for (int x = 0; x < kSquares; ++x)
            for (int c = 0; c < 4; ++c) image.rgba.push_back((x ^ y) & 1 || c == 3 ? 255 : 0);
    scene.images.push_back(std::move(image));
    scene.materials.resize(1);
    scene.materials[0].baseColorTexture.image = 0;
    scene.materials[0].baseColorTexture.nearest = true;
    Primitive floor;
    floor.positions = {{-32, 0, 32}, {32, 0, 32}, {32, 0, -32}, {-32, 0, -32}};
    floor.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    floor.indices = {0, 1, 2, 0, 2, 3};
    addObject(scene, std::move(floor));
    return scene;
}

HdrImage albedo(const PictureDesc& desc) {
    const Context context = Context::create().value();
    const Scene scene = chessFloor();
    const auto tracer = makeEmbreeTracer(context, scene, poseAt(scene)).value();
    return renderPicture(context, *tracer, {}, nullptr, desc).value().picture.albedo;
}

float spread(const HdrImage& image) {
    const auto [low, high] = std::minmax_element(image.pixels.begin(), image.pixels.end(),
                                                 [](const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; });
    return high->x - low->x;
}

TEST(TextureFilter, AFarCheckerboardIsItsMean) {
    // 31 pixels over 60 m: each covers 31 squares along an axis, and a single sample would be black or white.
    const HdrImage image = albedo(fromAbove(30, 31, 31));
    for (const glm::vec3& pixel : image.pixels) EXPECT_NEAR(pixel.x, 0.5f, 0.005f);
}

TEST(TextureFilter, AtAGrazingAngleToo) {
    PictureDesc desc = fromAbove(1, 32, 8);
    desc.camera = lookAt({0, 0.5f, 32}, {0, 0, 0}, 0.012f);
    const HdrImage image = albedo(desc);
    for (const glm::vec3& pixel : image.pixels) EXPECT_NEAR(pixel.x, 0.5f, 0.02f);
}

TEST(TextureFilter, NearByItsSquares) {
    const HdrImage image = albedo(fromAbove(0.1f, 64, 64));  // 20 pixels per square
    EXPECT_EQ(spread(image), 1);
    for (const glm::vec3& pixel : image.pixels) EXPECT_TRUE(pixel.x == 0 || pixel.x == 1);
}

// The picture's mean with a filter and few samples equals that without a filter and with many.
TEST(TextureFilter, KeepsTheMeanInBetween) {
    for (const float height : {0.5f, 2.0f, 8.0f}) {
        const HdrImage image = albedo(fromAbove(height, 48, 48));
        double sum = 0;
        for (const glm::vec3& pixel : image.pixels) sum += pixel.x;
        EXPECT_NEAR(sum / double(image.pixels.size()), 0.5, 0.03) << height;
    }
}

}  // namespace
}  // namespace probegi::test
