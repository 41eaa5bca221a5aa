#pragma once

#include <string>

#include "probegi/scene.h"

namespace probegi {

// Meshes of code instead of files: shapes that are appended to a Primitive, in metres, each with flat normals and uv0
// in metres (a material's uv transform alone sets the size of its texture). The primitive must be new or made of shapes
// alone; Primitive::material says what they are made of.

/// A parallelogram with corners `corner`, `corner + right`, `corner + right + up`, `corner + up`: it faces
/// cross(right, up), which must not be zero.
PROBEGI_API void addQuad(Primitive& out, glm::vec3 corner, glm::vec3 right, glm::vec3 up);

/// A solid box between two corners, lower < upper on every axis: its six faces look outwards.
PROBEGI_API void addBox(Primitive& out, glm::vec3 lower, glm::vec3 upper);

/// The same box as a hollow room: its six faces look inwards.
PROBEGI_API void addRoom(Primitive& out, glm::vec3 lower, glm::vec3 upper);

/// Adds a mesh of one primitive and a root node that places it where its coordinates say. Returns the node's index:
/// what MovableDesc::nodes names, and what a pose moves.
PROBEGI_API int addObject(Scene& scene, Primitive primitive, std::string name = {});

}  // namespace probegi
