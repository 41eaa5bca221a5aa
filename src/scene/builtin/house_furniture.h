#pragma once

#include "probegi/scene.h"

/// Furniture made of closed solids. Each function adds one mesh and returns its index; it stands on y = 0 with its back
/// to -Z.
namespace probegi::builtin {

int addTable(Scene& scene, int material, glm::vec3 size);
int addChair(Scene& scene, int wood, int seat);
int addSofa(Scene& scene, int cloth, float width);
int addBed(Scene& scene, int wood, int sheet, int blanket);
/// Shelves with books in the given colours.
int addBookcase(Scene& scene, int wood, const std::vector<int>& books);
int addKitchenBlock(Scene& scene, int body, int top, float width);
int addLamp(Scene& scene, int foot, int shade);
int addTree(Scene& scene, int bark, int foliage, int seed);
int addRug(Scene& scene, int material, float width, float depth);

}  // namespace probegi::builtin
