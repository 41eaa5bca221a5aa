// The public door to a backend.
#include "backend/every_backend.h"

namespace probegi::test {
namespace {

class BackendDoor : public EveryBackend {};
PROBEGI_ON_EVERY_BACKEND(BackendDoor);

// From a scene to a picture without a word about where it happens; what a backend made outlives it.
TEST_P(BackendDoor, opensAllThatAPictureNeeds) {
    const Scene scene = makeBuiltinScene("cornell").value();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    auto backend = made(GetParam().open(context));
    const auto tracer = made(backend->openScene(scene, pose));
    FieldDesc desc;
    desc.volumes = {placeVolume(pose.bounds, {.counts = {4, 4, 4}}).value()};
    Field field = made(backend->makeField(desc));
    const auto renderer = made(backend->makeRenderer());
    backend.reset();
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(field.update(*tracer, lighting));
    const PictureDesc view{pose.cameras.empty() ? overviewCamera(pose.bounds) : pose.cameras[0], 24, 16, 1, false};
    const RenderedPicture dark = made(renderer->render(*tracer, lighting, nullptr, view));
    const RenderedPicture lit = made(renderer->render(*tracer, lighting, &field, view));
    const RenderedPicture again = made(renderer->render(*tracer, lighting, &field, view));
    EXPECT_EQ(dark.picture.indirect.pixels, std::vector<glm::vec3>(24 * 16, glm::vec3(0.0f)));
    double sum = 0;
    for (const glm::vec3& pixel : lit.picture.indirect.pixels) sum += pixel.y;
    EXPECT_GT(sum, 1.0);
    EXPECT_EQ(again.picture.color.pixels, lit.picture.color.pixels) << "a renderer remembers no picture";
}

TEST_P(BackendDoor, movesWhatMoves) {
    const Scene scene = makeBuiltinScene("cornell").value();
    ScenePose pose = poseAt(scene);
    const int node = pose.instances[0].node;
    const auto backend = made(GetParam().open(context));
    const auto tracer = made(backend->openMovableScene(scene, pose, {.animated = false, .nodes = {&node, 1}}));
    const glm::vec3 centre = pose.bounds.centre();
    for (Instance& instance : pose.instances)
        if (instance.node == node) instance.toWorld[3] += glm::vec4(0, 1000, 0, 0);
    ASSERT_TRUE(tracer->setPose(pose));
    EXPECT_GT(tracer->bounds().upper.y, centre.y + 900);
    const int absent = 12345;
    EXPECT_EQ(backend->openMovableScene(scene, pose, {.nodes = {&absent, 1}}).error().code, ErrorCode::invalidArgument);
}

TEST(OpenBackend, theCpuIsTheDefault) {
    const Context context = *Context::create();
    EXPECT_EQ((*openBackend(context))->kind(), BackendKind::cpu);
}

TEST(OpenBackend, aDeviceThatIsNotThereIsSaid) {
    const Context context = *Context::create();
    const auto opened = openBackend(context, {.kind = BackendKind::vulkan, .device = "no such device"});
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().code, ErrorCode::unsupported);
}

#ifdef PROBEGI_TEST_VULKAN
TEST(OpenBackend, opensADeviceForVulkan) {
    const Context context = *Context::create();
    const auto opened = openBackend(
        context, {.kind = BackendKind::vulkan, .device = testDevice().info().name, .tracer = TracerKind::bvh});
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ((*opened)->kind(), BackendKind::vulkan);
    EXPECT_TRUE((*opened)->makeField({}));
}
#endif

}  // namespace
}  // namespace probegi::test
