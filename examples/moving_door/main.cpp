// A door opens and shuts: each frame the tracer gets its pose and rebuilds nothing else; the field is notified that a
// large object moves. The path tracer provides the reference for the room behind the door.
#include <chrono>
#include <cstdio>

#include "house.h"

using namespace probegi;

namespace {

constexpr PlacedLight kLamp{.type = LightType::point, .position = {-2, 2.5f, 0.5f}, .intensity = {30, 30, 30}};
constexpr float kOpen = 1.4f;  // radians
constexpr int kSwing = 30, kRest = 30;

/// Like .value(): throws on failure.
void must(const Result<void>& done) {
    if (!done) throw BadResult(done.error());
}

struct World {
    House house;
    Lighting lighting{{kLamp}, {}};
    Context context = Context::create().value();
    std::unique_ptr<MovableTracer> tracer;
    Field field;

    World() : tracer(makeTracer()), field(makeField()) {}

    std::unique_ptr<MovableTracer> makeTracer() {
        const int nodes[] = {house.door};
        return makeMovableEmbreeTracer(context, house.scene, house.poseWithDoor(0), {.nodes = nodes}).value();
    }
    Field makeField() {
        FieldDesc desc;
        desc.volumes = {placeVolume(house.poseWithDoor(0).bounds, {.targetProbes = 2000}).value()};
        return Field::create(context, desc).value();
    }
};

/// Mean irradiance on the second room's walls.
float secondRoom(const World& world) {
    const std::vector<FieldQuery> points = world.house.secondRoom();
    std::vector<glm::vec3> answers(points.size());
    must(world.field.irradiance(points, answers));
    float sum = 0;
    for (const glm::vec3& e : answers) sum += e.y;
    return sum / float(points.size());
}

float truthOfSecondRoom(const World& world, float angle) {
    const ScenePose pose = world.house.poseWithDoor(angle);
    const auto reference =
        PathTracer::create(world.context, world.house.scene, pose, *world.tracer, world.lighting).value();
    const std::vector<FieldQuery> points = world.house.secondRoom();
    const std::vector<ReferenceIrradiance> answers = reference.irradiance(points, 500).value();
    float sum = 0;
    for (const ReferenceIrradiance& e : answers) sum += e.mean.y;
    return sum / float(points.size());
}

/// Plays frames while the door swings from one angle to another, and some at rest. Returns milliseconds per move.
double playFrames(World& world, float from, float to) {
    using Clock = std::chrono::steady_clock;
    double moving = 0;
    for (int frame = 1; frame <= kSwing + kRest; ++frame) {
        if (frame <= kSwing) {
            const float angle = from + (to - from) * float(frame) / float(kSwing);
            const auto start = Clock::now();
            must(world.tracer->setPose(world.house.poseWithDoor(angle)));
            moving += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
            world.field.control().notify(FieldEvent::largeObjectChange);
        }
        world.field.update(*world.tracer, world.lighting).value();
        if (frame % 30 == 0) std::printf("  frame %3d: %.3f W/m^2\n", frame, secondRoom(world));
    }
    return moving / kSwing;
}

bool run() {
    World world;
    std::puts("shut");
    playFrames(world, 0, 0);
    const float before = secondRoom(world);
    std::puts("opening");
    const double ms = playFrames(world, 0, kOpen);
    const float open = secondRoom(world), truth = truthOfSecondRoom(world, kOpen);
    std::puts("shutting");
    playFrames(world, kOpen, 0);
    const float after = secondRoom(world);
    std::printf("behind the door: %.4f shut, %.3f open (path traced %.3f), %.4f shut again; a move took %.2f ms\n",
                before, open, truth, after, ms);
    return before < 0.02f * truth && open > 0.8f * truth && open < 1.25f * truth && after < 0.04f * truth;
}

}  // namespace

int main() {
    try {
        return run() ? 0 : 1;
    } catch (const BadResult& failure) {
        std::fprintf(stderr, "moving_door: %s\n", failure.error().message.c_str());
        return 1;
    }
}
