// Masks that follow moving geometry, against bakes of the scene as it is.
#include "probegi/mask_updater.h"

#include <gmock/gmock.h>

#include <glm/ext/matrix_transform.hpp>

#include "halls.h"
#include "kernels/guards/masks.h"
#include "probegi/builtin_scenes.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

/// The hall with a wall that has a doorway, and a door in it that slides, turns and sinks.
struct DoorHall {
    explicit DoorHall(int threads = 1) : halls(makeScene(), threads) {
        pose = poseAt(halls.scene);
        tracer =
            makeMovableEmbreeTracer(halls.context, halls.scene, pose, {.animated = true, .nodes = doorNodes}).value();
    }

    static Scene makeScene() {
        Scene scene;
        scene.materials.resize(1);
        Primitive room, wall, door;
        addRoom(room, {-2, 0, -2}, {2, 3, 2});
        addBox(wall, {0.165f, -0.01f, -2.01f}, {0.175f, 3.01f, -0.5f});
        addBox(wall, {0.165f, -0.01f, 0.5f}, {0.175f, 3.01f, 2.01f});
        addBox(wall, {0.165f, 2.2f, -0.5f}, {0.175f, 3.01f, 0.5f});
        addBox(door, {-0.005f, -0.01f, -0.5f}, {0.005f, 2.2f, 0.5f});
        addObject(scene, std::move(room));
        addObject(scene, std::move(wall));
        addObject(scene, std::move(door));
        scene.nodes.back().translation = {0.17f, 0, 0};
        return scene;
    }

    /// The door moved and turned about the vertical through its middle.
    void place(glm::vec3 shift, float angle = 0) {
        pose = poseAt(halls.scene);
        for (Instance& instance : pose.instances)
            if (instance.node == doorNodes[0])
                instance.toWorld = glm::rotate(glm::translate(instance.toWorld, shift), angle, {0, 1, 0});
        ASSERT_TRUE(tracer->setPose(pose));
    }
    OrientedBox box() const {
        OrientedBox box;
        for (const Instance& instance : pose.instances) {
            if (instance.node != doorNodes[0]) continue;
            box.centre = glm::vec3(instance.toWorld * glm::vec4(0, 1.095f, 0, 1));
            const glm::vec3 half(0.005f, 1.105f, 0.5f);
            for (int axis = 0; axis < 3; ++axis) box.halfAxes[axis] = glm::vec3(instance.toWorld[axis]) * half[axis];
        }
        return box;
    }
    std::shared_ptr<const Masks> bake(const MaskDesc& desc) const {
        return bakeMasks(halls.context, *tracer, Halls::field(), desc).value();
    }
    MaskUpdater updater(const MaskDesc& desc) const {
        const OrientedBox at = box();
        return MaskUpdater::create(halls.context, *tracer, Halls::field(), desc, std::span(&at, 1)).value();
    }
    void follow(MaskUpdater& updater) const {
        const OrientedBox at = box();
        ASSERT_TRUE(updater.move(std::span(&at, 1)));
        const auto done = updater.update(*tracer);
        ASSERT_TRUE(done);
        EXPECT_TRUE(done->settled);
        EXPECT_TRUE(updater.settled());
    }

    static constexpr int doorNodes[] = {2};
    Halls halls;
    ScenePose pose;
    std::unique_ptr<MovableTracer> tracer;
};

/// Everything that a look-up reads, whatever the order of the cubes.
void expectEqual(const Masks& a, const Masks& b) {
    ASSERT_EQ(a.clusters(), b.clusters());
    const VolumeDesc& v = a.volumes()[0];
    int differ = 0;
    for (int slot = 0; slot < probeCount(v); ++slot)
        differ += a.words()[2 * std::size_t(slot) + 1] != b.words()[2 * std::size_t(slot) + 1];
    EXPECT_EQ(differ, 0) << "clusters or links";
    differ = 0;
    for (int z = 0; z + 1 < v.counts.z; ++z)
        for (int y = 0; y + 1 < v.counts.y; ++y)
            for (int x = 0; x + 1 < v.counts.x; ++x)
                for (int t = 0; t < a.factor() * a.factor() * a.factor(); ++t) {
                    const int f = a.factor(), slot = x + v.counts.x * (y + v.counts.y * z);
                    const glm::ivec3 texel(t % f, t / f % f, t / (f * f));
                    differ += texelAt(a, slot, texel) != texelAt(b, slot, texel);
                }
    EXPECT_EQ(differ, 0) << "texels";
}

TEST(MaskUpdater, withEightClustersIsAFullBake) {
    for (const int threads : {1, 2}) {
        DoorHall hall(threads);
        const MaskDesc desc{.clusters = 8, .factor = 4};
        MaskUpdater updater = hall.updater(desc);
        for (const auto& [shift, angle] : {std::pair{glm::vec3(0, 0, 1.0f), 0.0f},
                                           {glm::vec3(0, 0, -0.3f), 0.0f},
                                           {glm::vec3(-0.5f, 0, 0), 1.2f},
                                           {glm::vec3(0.6f, 0.4f, 0.3f), 0.7f},
                                           {glm::vec3(0, -9, 0), 0.0f},
                                           {glm::vec3(0), 0.0f}}) {
            hall.place(shift, angle);
            hall.follow(updater);
            expectEqual(*updater.masks(), *hall.bake(desc));
        }
    }
}

TEST(MaskUpdater, beginsAsABake) {
    const DoorHall hall;
    const MaskDesc desc{.factor = 4};
    const MaskUpdater updater = hall.updater(desc);
    const auto baked = hall.bake(desc);
    EXPECT_TRUE(std::ranges::equal(updater.masks()->words(), baked->words()));
    EXPECT_TRUE(updater.settled());
}

TEST(MaskUpdater, aDoorThatIsShutAgainHasItsFirstMasks) {
    DoorHall hall;
    for (const MaskDesc& desc : {MaskDesc{.factor = 4}, MaskDesc{.clusters = 2, .factor = 5, .strict = true}}) {
        hall.place({});
        MaskUpdater updater = hall.updater(desc);
        const auto first = updater.masks();
        for (const float shift : {0.3f, 0.9f, 1.4f}) {
            hall.place({0, 0, shift});
            hall.follow(updater);
            EXPECT_NE(updater.masks(), first);
        }
        const auto open = updater.masks();
        hall.place({});
        hall.follow(updater);
        expectEqual(*updater.masks(), *first);
        // By another way to the same place: the same masks.
        hall.place({-1, 0, 0}, 0.5f);
        hall.follow(updater);
        hall.place({0, 0, 1.4f});
        hall.follow(updater);
        expectEqual(*updater.masks(), *open);
    }
}

TEST(MaskUpdater, throughADoorwayIsSeenOnlyWhileItIsOpen) {
    DoorHall hall;
    MaskUpdater updater = hall.updater({.clusters = 4, .factor = 8});
    // Of the cell in the doorway: how many texels left of the wall see the cluster of a probe right of it.
    const int slot = 3 + 8 * (2 + 6 * 3);
    const auto seen = [&] {
        int count = 0;
        for (int t = 0; t < 512; ++t) {
            const glm::ivec3 texel(t & 7, t >> 3 & 7, t >> 6);
            if (texel.x < 3) count += maskAt(*updater.masks(), slot, texel) >> updater.masks()->cluster(slot + 1) & 1u;
        }
        return count;
    };
    EXPECT_EQ(seen(), 0);
    hall.place({0, 0, 1.05f});
    hall.follow(updater);
    EXPECT_GT(seen(), 150);
    hall.place({});
    hall.follow(updater);
    EXPECT_EQ(seen(), 0);
}

TEST(MaskUpdater, littleByLittleComesToTheSame) {
    DoorHall hall(2);
    const MaskDesc desc{.clusters = 3, .factor = 4};
    MaskUpdater atOnce = hall.updater(desc), slow = hall.updater(desc);
    hall.place({0, 0, 0.8f});
    hall.follow(atOnce);
    const OrientedBox at = hall.box();
    ASSERT_TRUE(slow.move(std::span(&at, 1)));
    EXPECT_FALSE(slow.settled());
    const auto first = slow.masks();
    int calls = 0;
    for (bool settled = false; !settled; ++calls) {
        ASSERT_LT(calls, 1000);
        const auto done = slow.update(*hall.tracer, {.cells = 3});
        ASSERT_TRUE(done);
        EXPECT_LE(done->seenCells + done->solvedCells, 3u);
        settled = done->settled;
        EXPECT_EQ(done->published, settled);
        EXPECT_EQ(slow.masks() == first, !settled) << "until all is done look-ups read what was";
    }
    EXPECT_GT(calls, 10);
    expectEqual(*slow.masks(), *atOnce.masks());
}

// The door goes on while the cells of its last place are still being solved.
TEST(MaskUpdater, whatMovesOnIsCaughtUp) {
    DoorHall hall;
    const MaskDesc desc{.clusters = 4, .factor = 4};
    MaskUpdater updater = hall.updater(desc), atOnce = hall.updater(desc);
    int published = 0;
    for (int frame = 1; frame <= 30; ++frame) {
        hall.place({0, 0, 0.04f * float(frame)}, 0.02f * float(frame));
        const OrientedBox at = hall.box();
        ASSERT_TRUE(updater.move(std::span(&at, 1)));
        const auto done = updater.update(*hall.tracer, {.cells = 25});
        ASSERT_TRUE(done);
        published += done->published;
    }
    EXPECT_GT(published, 3) << "it does not wait until things stand still";
    while (!updater.settled()) ASSERT_TRUE(updater.update(*hall.tracer, {.cells = 25}));
    hall.follow(atOnce);
    expectEqual(*updater.masks(), *atOnce.masks());
}

TEST(MaskUpdater, onlyWhatIsNearIsDoneAgain) {
    DoorHall hall;
    const MaskDesc desc{.factor = 4};
    MaskUpdater updater = hall.updater(desc);
    auto done = updater.update(*hall.tracer).value();
    EXPECT_EQ(done.rays, 0u) << "nothing moved";
    EXPECT_FALSE(done.published);
    hall.place({0, 0, 0.1f});
    const OrientedBox at = hall.box();
    ASSERT_TRUE(updater.move(std::span(&at, 1)));
    done = updater.update(*hall.tracer).value();
    EXPECT_GT(done.seenCells, 0u);
    EXPECT_LT(done.seenCells, updater.masks()->report().blocked / 4);
    EXPECT_LT(done.rays, updater.masks()->report().rays / 4);
    ASSERT_TRUE(updater.move(std::span(&at, 1)));
    EXPECT_TRUE(updater.settled()) << "it did not move";
}

/// Fails until it is told to work.
class Unreliable : public Tracer {
public:
    explicit Unreliable(const Tracer& to) : m_to(to) {}
    Result<void> closestHits(std::span<const Ray> rays, std::span<Hit> hits) const override {
        return works ? m_to.closestHits(rays, hits) : fail(ErrorCode::deviceLost, "lost");
    }
    Result<void> occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
        return --left >= 0 || works ? m_to.occluded(rays, blocked) : fail(ErrorCode::deviceLost, "lost");
    }
    Result<void> surfaces(std::span<const Ray> rays, std::span<const Hit> hits, std::span<Surface> out) const override {
        return m_to.surfaces(rays, hits, out);
    }
    Bounds bounds() const override { return m_to.bounds(); }

    bool works = false;
    mutable int left = 3;

private:
    const Tracer& m_to;
};

TEST(MaskUpdater, goesOnAfterAnError) {
    DoorHall hall;
    const MaskDesc desc{.factor = 4};
    MaskUpdater updater = hall.updater(desc), other = hall.updater(desc);
    hall.place({0, 0, 0.7f});
    hall.follow(other);
    const OrientedBox at = hall.box();
    ASSERT_TRUE(updater.move(std::span(&at, 1)));
    Unreliable tracer(*hall.tracer);
    const auto failed = updater.update(tracer);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::deviceLost);
    EXPECT_FALSE(updater.settled());
    tracer.works = true;
    ASSERT_TRUE(updater.update(tracer));
    expectEqual(*updater.masks(), *other.masks());
}

TEST(MaskUpdater, refusesOtherBoxes) {
    DoorHall hall;
    MaskUpdater updater = hall.updater({.factor = 4});
    const auto complaint = [&](std::vector<OrientedBox> boxes) {
        const auto moved = updater.move(boxes);
        return moved ? std::string() : moved.error().message;
    };
    EXPECT_THAT(complaint({}), HasSubstr("there are 0 moving boxes; at first there were 1"));
    EXPECT_THAT(complaint({{}, {}}), HasSubstr("there are 2"));
    EXPECT_THAT(complaint({{.centre = glm::vec3(std::nanf(""))}}), HasSubstr("not finite"));
    EXPECT_TRUE(updater.settled());
    EXPECT_THAT(updater.update(*hall.tracer, {.milliseconds = -1}).error().message, HasSubstr("budget"));
    EXPECT_THAT(updater.update(*hall.tracer, {.cells = -1}).error().message, HasSubstr("budget"));
    const OrientedBox odd{.centre = {}, .halfAxes = {{INFINITY, 0, 0}, {}, {}}};
    EXPECT_FALSE(MaskUpdater::create(hall.halls.context, *hall.tracer, Halls::field(), {}, std::span(&odd, 1)));
    EXPECT_FALSE(MaskUpdater::create(hall.halls.context, *hall.tracer, Halls::field(), {.clusters = 9}, {}));
}

// A sheet of no thickness, and a box of no size at all.
TEST(MaskUpdater, thinThingsMoveToo) {
    Scene scene;
    scene.materials.resize(1);
    Primitive sheet;
    addQuad(sheet, {-2, -1, -1}, {0, 0, 4}, {0, 4, 0});
    addObject(scene, std::move(sheet));
    const Halls halls(std::move(scene), 1);
    const int nodes[] = {0};
    const auto tracer = makeMovableEmbreeTracer(halls.context, halls.scene, halls.pose, {.nodes = nodes}).value();
    FieldDesc field;
    field.volumes = {{glm::vec3(0), glm::vec3(0.7f), {3, 3, 3}}};
    std::vector<OrientedBox> boxes{{{-2, 1, 1}, {{0, 0, 0}, {0, 2, 0}, {0, 0, 2}}}, {}};
    const MaskDesc desc{.clusters = 8, .factor = 5};
    MaskUpdater updater = MaskUpdater::create(halls.context, *tracer, field, desc, boxes).value();
    EXPECT_EQ(updater.masks()->report().cubes, 1u) << "the sheet is outside";
    ScenePose pose = halls.pose;
    pose.instances[0].toWorld = glm::translate(glm::mat4(1.0f), {2.3f, 0, 0});
    ASSERT_TRUE(tracer->setPose(pose));
    boxes[0].centre.x = 0.3f;
    boxes[1].centre = {0.9f, 0.9f, 0.9f};
    ASSERT_TRUE(updater.move(boxes));
    ASSERT_TRUE(updater.update(*tracer));
    expectEqual(*updater.masks(), *bakeMasks(halls.context, *tracer, field, desc).value());
    EXPECT_GT(updater.masks()->report().cubes, 1u);
}

TEST(MovingBoxes, standAsTheirNodesDo) {
    const Scene scene = makeBuiltinScene("door").value();
    for (const float seconds : {0.0f, 2.0f, 3.0f}) {
        const ScenePose pose = poseAt(scene, seconds);
        const auto boxes = movingBoxes(scene, pose);
        const auto bounds = movingBounds(scene, pose);
        ASSERT_EQ(boxes.size(), 1u);
        ASSERT_EQ(bounds.size(), 1u);
        const glm::vec3 reach = abs(boxes[0].halfAxes[0]) + abs(boxes[0].halfAxes[1]) + abs(boxes[0].halfAxes[2]);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(boxes[0].centre[axis] - reach[axis], bounds[0].lower[axis], 1e-4f);
            EXPECT_NEAR(boxes[0].centre[axis] + reach[axis], bounds[0].upper[axis], 1e-4f);
        }
    }
}

}  // namespace
}  // namespace probegi::test
