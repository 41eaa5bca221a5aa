#pragma once

#include <glm/vec3.hpp>

#include "probegi/scene.h"

/// Textures painted by code, at most 512 x 512, all tileable but the leaf. Colours are linear albedo, stored as sRGB. A
/// texture's mean is close to the requested colour.
namespace probegi::builtin {

TextureImage plasterTexture(glm::vec3 colour, int seed);
/// Running courses of dressed stone, `columns` x `rows` blocks.
TextureImage masonryTexture(glm::vec3 stone, glm::vec3 mortar, int columns, int rows, int seed);
TextureImage masonryNormals(int columns, int rows, int seed);
/// 2 x 2 square tiles in two colours with small dark squares at the corners.
TextureImage inlayFloorTexture(glm::vec3 light, glm::vec3 dark, glm::vec3 corner);
/// rows x rows square tiles that vary slightly, with grout.
TextureImage squareTilesTexture(glm::vec3 tile, glm::vec3 grout, int rows, int seed);
TextureImage plankTexture(glm::vec3 wood, int planks, int seed);
/// Overlapping rows of round roof tiles.
TextureImage roofTexture(glm::vec3 clay, int seed);
/// Woven pattern of stylised flowers in two tones, with a border of `trim` along u = 0 and u = 1.
TextureImage clothTexture(glm::vec3 ground, glm::vec3 figure, glm::vec3 trim);
TextureImage grassTexture(glm::vec3 colour, int seed);
/// One leaf pointing from v = 1 to v = 0, transparent around it.
TextureImage leafTexture(glm::vec3 colour);

}  // namespace probegi::builtin
