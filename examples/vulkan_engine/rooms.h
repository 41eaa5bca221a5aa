#pragma once

#include <probegi/field.h>
#include <probegi/scene.h>

#include <array>
#include <glm/mat4x4.hpp>

/// The engine's scene: two rooms of boxes with a door between them, daylight through a hole in one roof, and a moving
/// crate. The structs match shaders/rooms.glsl (scalar layout).

struct Box {
    glm::vec3 lower, upper;  ///< metres
    glm::vec3 albedo;
};

inline constexpr int kBoxes = 17;
inline constexpr int kFrontWalls = 1;  ///< the first box: it blocks light, but is hidden from the camera
inline constexpr int kCrate = kBoxes - 1;
inline constexpr glm::vec3 kEye{0, 2.9f, 17};  ///< camera position, outside the house

/// Per-frame data for shaders.
struct FrameData {
    glm::mat4 worldToClip;
    glm::vec3 toSun;          ///< unit
    glm::vec3 sunIrradiance;  ///< W m^-2 at normal incidence
    glm::vec3 skyRadiance;    ///< W sr^-1 m^-2
    int boxCount;
    std::array<Box, kBoxes> boxes;
};

/// The engine's state at a time 0..1 of its animation: the sun rises, the crate slides.
FrameData frameAt(float time, float aspect);

/// The scene for ProbeGI: geometry once, lights and poses as they change.
probegi::Scene sceneOf(const FrameData& frame);
probegi::ScenePose poseOf(const probegi::Scene& scene, const FrameData& start, const FrameData& now);
probegi::Lighting lightingOf(const FrameData& frame);
probegi::FieldDesc fieldDesc();
probegi::FieldSettings fieldSettings();

/// Points all over a room (0: the one with the hole in its roof, 1: the other), each facing the six axis directions.
std::vector<probegi::FieldQuery> questionsIn(const FrameData& frame, int room);
