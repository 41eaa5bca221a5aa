#pragma once

#include <glm/vec3.hpp>

#include "probegi/scene.h"

/// Things on a desk, made of closed solids. Each function adds one mesh and returns its index; it stands on y = 0.
namespace probegi::builtin {

/// A mug with a handle, 10 cm high.
int addMug(Scene& scene, int glaze);
/// A foot, two arms and a shade that opens downwards over (0, 0.35, 0.22), with a bulb in it.
int addDeskLamp(Scene& scene, int metal, int bulb);
/// A carton without a lid.
int addOpenBox(Scene& scene, int card, glm::vec3 size);
/// Sheets in bundles that lie a little askew, `height` metres in all.
int addPaperStack(Scene& scene, int paper, float height, int seed);
/// Books that lie on each other, or stand in a row.
int addBookPile(Scene& scene, const std::vector<int>& covers, int count, int seed);
int addBookRow(Scene& scene, const std::vector<int>& covers, int count, int seed);
/// A round basket, open at the top.
int addBasket(Scene& scene, int wire);

}  // namespace probegi::builtin
