#pragma once

#include <string>

#include "probegi/scene.h"

namespace probegi {

// Meshes from code: shapes appended to a Primitive, in metres, with flat normals and uv0 in metres (so the material's
// uv transform alone sets the texture's size). The primitive must be empty or contain only such shapes;
// Primitive::material is their material.

/// A parallelogram with corners `corner`, `corner + right`, `corner + right + up`, `corner + up`: it faces
/// cross(right, up), which must not be zero.
PROBEGI_API void addQuad(Primitive& out, glm::vec3 corner, glm::vec3 right, glm::vec3 up);

/// A solid box between two corners, lower < upper on every axis; its six faces point outwards.
PROBEGI_API void addBox(Primitive& out, glm::vec3 lower, glm::vec3 upper);

/// The same box as a hollow room; its six faces point inwards.
PROBEGI_API void addRoom(Primitive& out, glm::vec3 lower, glm::vec3 upper);

/// Adds a mesh of one primitive and a root node without a transform. Returns the node's index, for MovableDesc::nodes
/// and poses.
PROBEGI_API int addObject(Scene& scene, Primitive primitive, std::string name = {});

}  // namespace probegi
