#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "probegi/scene.h"
#include "scene/builtin/mesh_builder.h"

/// Helpers that add elements to a Scene and return their index.
namespace probegi::builtin {

int addMaterial(Scene& scene, std::string name, glm::vec3 albedo, float roughness = 1.0f);
/// `metres`: size of one repetition of the image.
int addTextured(Scene& scene, std::string name, TextureImage image, float metres, float roughness = 1.0f);
/// With the uv transform of the material's base colour.
void addNormalMap(Scene& scene, int material, TextureImage normals, float scale);
int addEmitter(Scene& scene, std::string name, glm::vec3 radiance);

int addMesh(Scene& scene, Mesh mesh);
int addMesh(Scene& scene, std::string name, std::vector<MeshBuilder> parts);

/// Places a mesh, rotated by `yaw` radians about +Y.
int place(Scene& scene, int mesh, glm::vec3 position = glm::vec3(0), float yaw = 0, float scale = 1);

/// `direction`: in which the light travels, any length. `lux`: W m^-2 at normal incidence.
int addSun(Scene& scene, glm::vec3 direction, glm::vec3 lux);
int addPointLight(Scene& scene, std::string name, glm::vec3 position, glm::vec3 intensity);
int addCamera(Scene& scene, std::string name, glm::vec3 from, glm::vec3 at, float yfovDegrees = 60);

/// Moves a node along straight lines: at `times` (seconds) it is at `places`.
void addMotion(Scene& scene, int node, std::vector<float> times, const std::vector<glm::vec3>& places);
/// Turns a node about an axis: at `times` (seconds) by `degrees`, less than 180 from one to the next.
void addRotation(Scene& scene, int node, glm::vec3 axis, std::vector<float> times, const std::vector<float>& degrees);

}  // namespace probegi::builtin
