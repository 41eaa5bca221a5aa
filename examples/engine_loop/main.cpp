// A frame loop: a lamp is switched on and off; the field is notified, updated once per frame and queried. The result is
// checked against the walls' mean irradiance by energy conservation.
#include <probegi/probegi.h>

#include <cstdio>

#include "room.h"

using namespace probegi;

namespace {

constexpr float kPi = 3.14159265f;
constexpr int kFramesPerSwitch = 120;
constexpr PlacedLight kLamp{.type = LightType::point, .position = {3, 2, 2}, .intensity = {20, 20, 20}};

Result<float> meanOnWalls(const Field& field, std::span<const FieldQuery> points) {
    std::vector<glm::vec3> answers(points.size());
    if (const auto asked = field.irradiance(points, answers); !asked) return asked.error();
    float sum = 0;
    for (const glm::vec3& e : answers) sum += e.y;
    return sum / float(points.size());
}

/// Runs the loop with the lamp unchanged; returns the walls' mean indirect irradiance at the end.
Result<float> playFrames(Field& field, const Tracer& tracer, const Lighting& lighting, const Room& room) {
    const std::vector<FieldQuery> points = room.wallPoints();
    field.control().notify(FieldEvent::largeLightChange);  // adapts faster for some frames
    for (int frame = 1; frame <= kFramesPerSwitch; ++frame) {
        const auto times = field.update(tracer, lighting);
        if (!times) return times.error();
        if (frame % 20 != 0) continue;
        const auto mean = meanOnWalls(field, points);
        if (!mean) return mean;
        std::printf("  frame %3d: %6.3f W/m^2, update %.2f ms\n", frame, *mean, times->total);
    }
    return meanOnWalls(field, points);
}

Result<bool> runGame() {
    const Room room;
    const Scene scene = room.scene();
    const ScenePose pose = poseAt(scene);
    const auto context = Context::create();
    if (!context) return context.error();
    const auto tracer = makeEmbreeTracer(*context, scene, pose);
    if (!tracer) return tracer.error();
    FieldDesc desc;
    desc.volumes = {{.origin = glm::vec3(-0.25f), .spacing = glm::vec3(0.5f), .counts = {14, 8, 10}}};
    auto field = Field::create(*context, desc);
    if (!field) return field.error();

    std::puts("lamp on");
    const auto lit = playFrames(*field, **tracer, {.lights = {kLamp}, .sky = {}}, room);
    if (!lit) return lit.error();
    std::puts("lamp off");
    const auto dark = playFrames(*field, **tracer, {}, room);
    if (!dark) return dark.error();

    // The walls absorb all of the lamp's light in the end, and reflect a share `albedo` of it at each bounce.
    const float flux = 4 * kPi * kLamp.intensity.y;
    const float truth = flux / room.area() * Room::kAlbedo / (1 - Room::kAlbedo);
    std::printf("lit: %.3f W/m^2 (energy conservation: %.3f); dark: %.4f\n", *lit, truth, *dark);
    return *lit > 0.9f * truth && *lit < 1.1f * truth && *dark < 0.02f * truth;
}

}  // namespace

int main() {
    const auto right = runGame();
    if (!right) std::fprintf(stderr, "engine_loop: %s\n", right.error().message.c_str());
    return right.value_or(false) ? 0 : 1;
}
