// Moving something does not rebuild what stands still.
#include <gmock/gmock.h>

#include "cpu/embree_scene.h"
#include "probegi/builtin_scenes.h"
#include "probegi/probegi.h"

namespace probegi::test {
namespace {

TEST(MovingScene, AMoveBuildsNoTriangles) {
    Scene house = makeBuiltinScene("house").value();
    Primitive door;
    addBox(door, glm::vec3(0), glm::vec3(1, 2, 0.1f));
    const int node = addObject(house, door);
    const Context context = Context::create({.threads = 2}).value();
    const auto made = EmbreeScene::create(context, house, poseAt(house),
                                          [=](const Instance& instance) { return instance.node == node; });
    ASSERT_TRUE(made);
    const std::int64_t building = (*made)->allocatedBytes();
    house.nodes[std::size_t(node)].translation = {0.5f, 0, 0};
    ASSERT_TRUE((*made)->place(poseAt(house)));
    const std::int64_t moved = (*made)->allocatedBytes() - building;
    EXPECT_GT(building, 1 << 20);
    EXPECT_LT(moved, building / 100);
}

}  // namespace
}  // namespace probegi::test
