// Frames and the passes over them: with screen passes that only the test knows.
#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "render/picture_runner.h"
#include "render/quad_scene.h"

namespace probegi::test {
namespace {

// Colour of a pixel: how far its neighbours' samples are away. Writes what it does not read of them.
Result<void> lookAtNeighbours(PictureTask&, const PixelRect& part, Frame& frame) {
    const PixelRect& all = frame.rect();
    const int plane = frame.firstPlane();
    forEachPixel(part, [&](int x, int y) {
        const int right = std::min(x + 1, all.x + all.width - 1), below = std::min(y + 1, all.y + all.height - 1);
        frame.at(x, y, plane).direct = {frame.at(right, y, plane).distance, frame.at(x, below, plane).distance, 0};
    });
    return {};
}

// Two lamps over a floor with a board on it, so that there are shadows, and probes that know of them. The floor is
// everywhere, so that each pixel has a distance.
Picture passed(const std::vector<FramePass>& passes, const PictureDesc& desc, std::size_t framePixels = kFramePixels,
               int threads = 2) {
    const auto scene = QuadScene()
                           .floor(50, matt({0.5f, 0.4f, 0.3f}))
                           .quad({0, 0.5f, 0}, {1, 0, 0}, {0, 0, -1}, 0.3f, matt(glm::vec3(0.7f)))
                           .ready(threads);
    Lighting lighting;
    for (const float x : {-1.0f, 2.0f}) lighting.lights.push_back({.position = {x, 3, 1}, .intensity = {30, 20, 10}});
    FieldDesc of;
    of.volumes = {{.origin = {-4, -0.3f, -4}, .spacing = {2, 1, 2}, .counts = {5, 4, 5}}};
    Field field = Field::create(scene.context, of).value();
    for (int i = 0; i < 2; ++i) field.update(*scene.tracer, lighting).value();
    Picture p = runPicture(scene.context, {*scene.tracer, lighting, &field, desc}, passes, framePixels).value().picture;
    EXPECT_GT(p.indirect.at(desc.width / 2, desc.height / 2).x, 0.0f);
    return p;
}

PictureDesc view(int samplesPerAxis) {
    PictureDesc desc = fromAbove(2, 150, 70);  // several parts, and not a multiple of one
    desc.samplesPerAxis = samplesPerAxis;
    return desc;
}

// The list with a pass before the last.
std::vector<FramePass> with(const FramePass& pass) {
    std::vector<FramePass> passes = picturePasses();
    passes.insert(passes.end() - 1, pass);
    return passes;
}

// A ray along the edge of two triangles may meet either, as the rays beside it decide: the same point, but for
// rounding.
void expectSame(const HdrImage& a, const HdrImage& b) {
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        ASSERT_LE(glm::distance(a.pixels[i], b.pixels[i]), 1e-5f * glm::length(a.pixels[i])) << i;
}

void expectEqual(const Picture& a, const Picture& b) {
    expectSame(a.color, b.color);
    expectSame(a.direct, b.direct);
    expectSame(a.indirect, b.indirect);
    expectSame(a.irradiance, b.irradiance);
    expectSame(a.depth, b.depth);
    EXPECT_EQ(a.normal.pixels, b.normal.pixels);
    EXPECT_EQ(a.albedo.pixels, b.albedo.pixels);
}

Result<void> nothing(PictureTask&, const PixelRect&, Frame&) {
    return {};
}

TEST(FramePasses, aPassSeesNeighboursInTheWholePicture) {
    const PictureDesc desc = view(1);
    const Picture p = passed(with({lookAtNeighbours, nullptr, true}), desc);
    for (int y = 0; y < desc.height; ++y)
        for (int x = 0; x < desc.width; ++x) {
            const float right = p.depth.at(std::min(x + 1, desc.width - 1), y).x;
            const float below = p.depth.at(x, std::min(y + 1, desc.height - 1)).x;
            ASSERT_EQ(p.direct.at(x, y), glm::vec3(right, below, 0)) << x << ' ' << y;
        }
}

// Neighbours of the same sub-sample: their distances are those of a picture that is finer by as much.
TEST(FramePasses, planesAreSubSamples) {
    const PictureDesc desc = view(2);
    PictureDesc fine = desc;
    fine.width *= 2;
    fine.height *= 2;
    fine.samplesPerAxis = 1;
    const Picture p = passed(with({lookAtNeighbours, nullptr, true}), desc), f = passed(picturePasses(), fine);
    for (int y = 0; y + 1 < desc.height; ++y)
        for (int x = 0; x + 1 < desc.width; ++x) {
            glm::vec3 mean(0.0f);
            for (int s = 0; s < 4; ++s) {
                const int fx = 2 * x + s % 2, fy = 2 * y + s / 2;
                mean += 0.25f * glm::vec3(f.depth.at(fx + 2, fy).x, f.depth.at(fx, fy + 2).x, 0);
            }
            ASSERT_LT(glm::length(p.direct.at(x, y) - mean), 1e-4f) << x << ' ' << y;
        }
}

TEST(FramePasses, planeByPlaneIsAllPlanesTogether) {
    for (const int samples : {1, 2, 3})
        expectEqual(passed(with({nothing, nullptr, true}), view(samples)), passed(picturePasses(), view(samples)));
}

TEST(FramePasses, bandsAreTheWholePicture) {
    const PictureDesc desc = view(2);
    const Picture whole = passed(with({nothing, nullptr, true}), desc);
    // A row, less than one, a few rows that do not divide the height, all but one.
    for (const std::size_t pixels : {150, 1, 150 * 9 + 3, 150 * 69})
        expectEqual(passed(with({nothing, nullptr, true}), desc, pixels), whole);
}

TEST(FramePasses, neighboursEndWithTheBand) {
    const PictureDesc desc = view(1);
    const Picture p = passed(with({lookAtNeighbours, nullptr, true}), desc, 150 * 10);
    for (int y = 0; y < desc.height; ++y) ASSERT_EQ(p.direct.at(3, y).y, p.depth.at(3, y % 10 == 9 ? y : y + 1).x) << y;
}

// The one before it is done for all pixels, and the one after it has not begun.
TEST(FramePasses, aPassWithNeighboursWaitsAndIsWaitedFor) {
    const auto mark = [](PictureTask&, const PixelRect& part, Frame& frame) -> Result<void> {
        forEachSample(part, frame, [](ScreenSample& s) { s.metallic = s.metallic == 7.0f ? 9.0f : 7.0f; });
        return {};
    };
    const auto check = [](PictureTask&, const PixelRect& part, Frame& frame) -> Result<void> {
        int others = 0;
        forEachSample(frame.rect(), frame, [&](const ScreenSample& s) { others += s.metallic == 7.0f ? 0 : 1; });
        forEachSample(part, frame, [&](ScreenSample& s) { s.direct = glm::vec3(float(others)); });
        return {};
    };
    std::vector<FramePass> passes = picturePasses();
    passes.insert(passes.end() - 1, {FramePass{mark}, FramePass{check, nullptr, true}, FramePass{mark}});
    const Picture p = passed(passes, view(1));
    for (const glm::vec3& light : p.direct.pixels) ASSERT_EQ(light, glm::vec3(0));
}

TEST(FramePasses, anErrorOfAPassIsThePictures) {
    const auto scene = QuadScene().floor(5).ready(2);
    for (const bool neighbours : {false, true}) {
        const FramePass failing{[](PictureTask&, const PixelRect&, Frame&) -> Result<void> {
                                    return fail(ErrorCode::unsupported, "not this");
                                },
                                nullptr, neighbours};
        const PictureDesc desc = view(1);
        const auto refused = runPicture(scene.context, {*scene.tracer, {}, nullptr, desc}, with(failing));
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().message, "not this");
    }
}

TEST(FramePasses, largePicturesHaveBandsOfBoundedSize) {
    PictureDesc desc;
    desc.width = desc.height = 16384;
    EXPECT_EQ(frameRows(desc, kFramePixels), 512);
    desc.width = 3840;
    desc.height = 2160;
    EXPECT_EQ(frameRows(desc, kFramePixels), 2160);
}

}  // namespace
}  // namespace probegi::test
