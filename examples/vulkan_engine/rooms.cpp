#include "rooms.h"

#include <probegi/shapes.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

using namespace probegi;

namespace {

constexpr glm::vec3 kWhite{0.78f, 0.76f, 0.72f}, kRed{0.72f, 0.16f, 0.1f}, kBlue{0.16f, 0.32f, 0.62f},
    kWood{0.5f, 0.37f, 0.25f}, kYellow{0.8f, 0.55f, 0.12f}, kGreen{0.25f, 0.5f, 0.2f};

constexpr std::array<Box, kBoxes> kRooms{{
    {{-4.6f, -0.2f, 3}, {4.6f, 3.6f, 3.2f}, kWhite},   // front wall
    {{-4.6f, -0.2f, -3.2f}, {4.6f, 0, 3}, kWood},      // floor
    {{-4.6f, 0, -3.2f}, {4.6f, 3.4f, -3}, kWhite},     // back wall
    {{-4.6f, 0, -3}, {-4.4f, 3.4f, 3}, kRed},          // left, right
    {{4.4f, 0, -3}, {4.6f, 3.4f, 3}, kBlue},           //
    {{-0.1f, 0, -3}, {0.1f, 3.4f, -1}, kWhite},        // between the rooms, around the door
    {{-0.1f, 0, 1}, {0.1f, 3.4f, 3}, kWhite},          //
    {{-0.1f, 2.3f, -1}, {0.1f, 3.4f, 1}, kWhite},      //
    {{-1.2f, 3.4f, -3.2f}, {4.6f, 3.6f, 3}, kWhite},   // roof, around the hole
    {{-4.6f, 3.4f, -3.2f}, {-3.8f, 3.6f, 3}, kWhite},  //
    {{-3.8f, 3.4f, -3.2f}, {-1.2f, 3.6f, -1.8f}, kWhite},
    {{-3.8f, 3.4f, 1}, {-1.2f, 3.6f, 3}, kWhite},
    {{-4.1f, 0, -2.6f}, {-3, 0.9f, -1.9f}, kGreen},
    {{2, 0.75f, -1.6f}, {3.6f, 0.85f, -0.4f}, kYellow},  // a table
    {{2.7f, 0, -1.1f}, {2.9f, 0.75f, -0.9f}, kYellow},
    {{1, 0, -2.6f}, {1.5f, 2.2f, -2.1f}, kWhite},
    {{-0.4f, 0, -0.4f}, {0.4f, 0.8f, 0.4f}, kYellow},  // the crate, where frameAt() puts it
}};

bool near(const Box& box, glm::vec3 p, float distance) {
    return glm::all(glm::greaterThan(p, box.lower - distance)) && glm::all(glm::lessThan(p, box.upper + distance));
}

}  // namespace

FrameData frameAt(float time, float aspect) {
    FrameData frame{.worldToClip = {},
                    .toSun = glm::normalize(glm::vec3(-0.4f - 0.6f * time, 1.6f, -0.3f)),
                    .sunIrradiance = {20, 18, 15},
                    .skyRadiance = {0.35f, 0.5f, 0.75f},
                    .boxCount = kBoxes,
                    .boxes = kRooms};
    const glm::vec3 slide(-3.7f + 1.0f * time, 0, 1.9f);
    frame.boxes[kCrate].lower += slide;
    frame.boxes[kCrate].upper += slide;
    // A long lens from far away shows both rooms as in a doll's house.
    glm::mat4 projection = glm::perspectiveRH_ZO(glm::radians(16.8f), aspect, 1.0f, 50.0f);
    projection[1][1] *= -1;  // Vulkan's y points down
    frame.worldToClip = projection * glm::lookAt(kEye, glm::vec3(0, 1.45f, 0), glm::vec3(0, 1, 0));
    return frame;
}

Scene sceneOf(const FrameData& frame) {
    Scene scene;
    scene.name = "two rooms";
    for (int i = 0; i < kBoxes; ++i) {
        Material paint;
        paint.baseColor = glm::vec4(frame.boxes[i].albedo, 1);
        scene.materials.push_back(paint);
        Primitive box;
        box.material = i;
        addBox(box, frame.boxes[i].lower, frame.boxes[i].upper);
        addObject(scene, std::move(box), "box");
    }
    return scene;
}

ScenePose poseOf(const Scene& scene, const FrameData& start, const FrameData& now) {
    ScenePose pose = poseAt(scene);
    for (Instance& instance : pose.instances)
        if (instance.node == kCrate)
            instance.toWorld = glm::translate(glm::mat4(1), now.boxes[kCrate].lower - start.boxes[kCrate].lower);
    return pose;
}

Lighting lightingOf(const FrameData& frame) {
    Lighting lighting;
    lighting.lights.push_back(
        {.type = LightType::directional, .direction = -frame.toSun, .intensity = frame.sunIrradiance});
    lighting.sky.radiance = frame.skyRadiance;
    return lighting;
}

FieldDesc fieldDesc() {
    FieldDesc desc;
    // Walls lie between probes, and a layer of probes outside of them: 980 in all.
    desc.volumes = {{.origin = {-4.875f, -0.45f, -3.375f}, .spacing = glm::vec3(0.75f), .counts = {14, 7, 10}}};
    desc.fixedRays = 0;  // the engine's rays have none, and both volumes should adapt alike
    return desc;
}

FieldSettings fieldSettings() {
    return {.hysteresis = 0.9f, .visibilityHysteresis = 0.9f};  // the animation is short: adapt quickly
}

std::vector<FieldQuery> questionsIn(const FrameData& frame, int room) {
    constexpr std::array<glm::vec3, 6> kFacing{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    std::vector<FieldQuery> questions;
    for (int i = 0; i < 9 * 4 * 7; ++i) {
        const glm::vec3 p(room == 0 ? -4.1f + 0.45f * float(i % 9) : 0.5f + 0.45f * float(i % 9),
                          0.3f + 0.8f * float(i / 9 % 4), -2.7f + 0.9f * float(i / 36));
        if (std::any_of(frame.boxes.begin(), frame.boxes.end(), [&](const Box& box) { return near(box, p, 0.1f); }))
            continue;
        for (const glm::vec3& normal : kFacing) questions.push_back({p, normal, normal});
    }
    return questions;
}
