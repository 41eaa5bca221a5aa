#include "scene/builtin/textures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "kernels/screen/colour.h"
#include "scene/builtin/noise.h"

namespace probegi::builtin {

namespace {

constexpr float kTau = glm::two_pi<float>();

std::uint8_t toByte(float v) {
    return std::uint8_t(std::lround(255 * std::clamp(v, 0.0f, 1.0f)));
}

/// sRGB by table: std::pow per texel would dominate the time to make a scene.
std::uint8_t encode(float linear) {
    static const auto table = [] {
        std::array<std::uint8_t, 4097> t{};
        for (std::size_t i = 0; i < t.size(); ++i) t[i] = toByte(kernels::encodeSrgb(float(i) / 4096));
        return t;
    }();
    // Limited to the albedo of fresh plaster: brighter walls would bounce light almost for ever.
    return table[std::size_t(std::lround(4096 * std::clamp(linear, 0.0f, 0.85f)))];
}

/// Calls paint(u, v) -> linear RGB + alpha at the texel centres.
template <class Paint>
TextureImage paintImage(const char* name, int size, const Paint& paint) {
    TextureImage image{size, size, {}, name};
    image.rgba.reserve(4 * std::size_t(size) * size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec4 c = paint((float(x) + 0.5f) / float(size), (float(y) + 0.5f) / float(size));
            for (int k = 0; k < 3; ++k) image.rgba.push_back(encode(c[k]));
            image.rgba.push_back(toByte(c.w));
        }
    }
    return image;
}

glm::vec4 opaque(glm::vec3 c) {
    return glm::vec4(c, 1);
}

float smooth(float lower, float upper, float v) {
    return glm::smoothstep(lower, upper, v);
}

/// A point's position in a running bond: its block, and the distance to the block's edge in block heights.
struct Block {
    int column, row;
    float edge;
};

Block blockAt(float u, float v, int columns, int rows) {
    const float y = v * float(rows);
    const int row = int(y) % rows;
    const float x = u * float(columns) + (row % 2 == 0 ? 0.0f : 0.5f);
    const float fx = x - std::floor(x), fy = y - std::floor(y);
    const float aspect = float(rows) / float(columns);
    const float edge = std::min(std::min(fx, 1 - fx) * aspect, std::min(fy, 1 - fy));
    return {int(x) % columns, row, edge};
}

}  // namespace

TextureImage plasterTexture(glm::vec3 colour, int seed) {
    return paintImage("plaster", 256, [&](float u, float v) {
        const float stain = fractalNoise(u, v, 3, 4, seed), grain = fractalNoise(u, v, 48, 2, seed + 9);
        return opaque(colour * (0.86f + 0.2f * stain + 0.08f * grain));
    });
}

TextureImage masonryTexture(glm::vec3 stone, glm::vec3 mortar, int columns, int rows, int seed) {
    return paintImage("masonry", 512, [&](float u, float v) {
        const Block b = blockAt(u, v, columns, rows);
        const float tone = 0.84f + 0.3f * hash01(b.column, b.row, seed);
        const float warm = 0.06f * (hash01(b.column, b.row, seed + 1) - 0.5f);
        const float grain = 0.85f + 0.3f * fractalNoise(u, v, 8, 5, seed + 2);
        const glm::vec3 face = stone * tone * grain * glm::vec3(1 + warm, 1, 1 - warm);
        return opaque(glm::mix(mortar * grain, face, smooth(0.02f, 0.05f, b.edge)));
    });
}

TextureImage masonryNormals(int columns, int rows, int seed) {
    constexpr int kSize = 512;
    std::vector<float> height;
    height.reserve(std::size_t(kSize) * kSize);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float u = (float(x) + 0.5f) / kSize, v = (float(y) + 0.5f) / kSize;
            const float joint = smooth(0.01f, 0.09f, blockAt(u, v, columns, rows).edge);
            height.push_back(joint + 0.35f * fractalNoise(u, v, 24, 3, seed));
        }
    }
    const auto at = [&](int x, int y) { return height[std::size_t((y & 511) * kSize + (x & 511))]; };
    TextureImage image{kSize, kSize, {}, "masonry normals"};
    image.rgba.reserve(4 * std::size_t(kSize) * kSize);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            // glTF's normal maps have +Y upwards in the picture, against v.
            const glm::vec3 n =
                glm::normalize(glm::vec3(at(x - 1, y) - at(x + 1, y), at(x, y + 1) - at(x, y - 1), 1.2f));
            for (int k = 0; k < 3; ++k) image.rgba.push_back(toByte(0.5f + 0.5f * n[k]));
            image.rgba.push_back(255);
        }
    }
    return image;
}

TextureImage inlayFloorTexture(glm::vec3 light, glm::vec3 dark, glm::vec3 corner) {
    return paintImage("inlay floor", 512, [&](float u, float v) {
        const float x = 2 * u, y = 2 * v;
        const int i = int(x), j = int(y);
        const float fx = x - float(i), fy = y - float(j);
        const float vein = std::abs(fractalNoise(u + 0.37f * float(i), v + 0.61f * float(j), 6, 5, 71) - 0.5f);
        const float marble = 1 - 0.35f * (1 - smooth(0.0f, 0.05f, vein)) + 0.15f * (fractalNoise(u, v, 4, 4, 5) - 0.5f);
        glm::vec3 c = (i + j) % 2 == 0 ? light : dark;
        const float cx = std::min(fx, 1 - fx), cy = std::min(fy, 1 - fy);
        if (cx + cy < 0.22f) c = corner;
        const float joint = std::min({cx, cy, std::abs(cx + cy - 0.22f) * 0.7f});
        return opaque(c * marble * (0.45f + 0.55f * smooth(0.004f, 0.012f, joint)));
    });
}

TextureImage squareTilesTexture(glm::vec3 tile, glm::vec3 grout, int rows, int seed) {
    return paintImage("square tiles", 512, [&](float u, float v) {
        const float x = u * float(rows), y = v * float(rows);
        const int i = int(x), j = int(y);
        const float fx = x - float(i), fy = y - float(j);
        const float edge = std::min({fx, 1 - fx, fy, 1 - fy});
        const float tone = 0.82f + 0.3f * hash01(i, j, seed) + 0.16f * (fractalNoise(u, v, 16, 4, seed) - 0.5f);
        return opaque(glm::mix(grout, tile * tone, smooth(0.015f, 0.04f, edge)));
    });
}

TextureImage plankTexture(glm::vec3 wood, int planks, int seed) {
    return paintImage("planks", 512, [&](float u, float v) {
        const float y = v * float(planks);
        const int j = int(y) % planks;
        const float fy = y - std::floor(y);
        const float shift = hash01(j, 3, seed);
        const float x = 2 * u + 2 * shift;
        const float fx = x - std::floor(x);
        const int i = int(x) % 2;
        // Fibres: noise stretched along the plank, a different part for each plank.
        const float fibre = fractalNoise(u + shift, 7 * v + hash01(i, j, seed), 4, 5, seed + 5);
        const float ring = 0.5f + 0.5f * std::sin(kTau * (2.5f * fibre + 3 * fy));
        const float tone = 0.82f + 0.3f * hash01(i, j, seed + 1);
        const float gap = smooth(0.01f, 0.03f, std::min(fy, 1 - fy)) * smooth(0.001f, 0.004f, std::min(fx, 1 - fx));
        return opaque(wood * tone * (0.86f + 0.2f * fibre + 0.08f * ring) * (0.35f + 0.65f * gap));
    });
}

TextureImage roofTexture(glm::vec3 clay, int seed) {
    constexpr int kColumns = 8, kRows = 6;
    return paintImage("roof tiles", 512, [&](float u, float v) {
        const float y = v * kRows;
        const int j = int(y) % kRows;
        const float fy = y - std::floor(y);
        const float x = u * kColumns + (j % 2 == 0 ? 0.0f : 0.5f);
        const int i = int(x) % kColumns;
        const float fx = 2 * (x - std::floor(x)) - 1;
        const float dome = std::sqrt(std::max(0.0f, 1 - fx * fx));
        const float lip = smooth(0.0f, 0.12f, 1 - fy - 0.18f * (1 - dome));
        const float tone = 0.75f + 0.4f * hash01(i, j, seed) + 0.2f * (fractalNoise(u, v, 12, 4, seed) - 0.5f);
        return opaque(clay * tone * (0.55f + 0.45f * dome) * (0.35f + 0.65f * lip));
    });
}

TextureImage clothTexture(glm::vec3 ground, glm::vec3 figure, glm::vec3 trim) {
    return paintImage("cloth", 512, [&](float u, float v) {
        // Staggered rosettes: a petal curve in polar coordinates around each lattice point, inside an ogee net.
        const float x = 4 * u, y = 4 * v;
        const int row = int(std::floor(y));
        const float fx = x + (row % 2 == 0 ? 0.0f : 0.5f), px = fx - std::floor(fx) - 0.5f, py = y - float(row) - 0.5f;
        const float r = std::sqrt(px * px + py * py), angle = std::atan2(py, px);
        const float petals = 0.2f + 0.09f * std::cos(6 * angle);
        const float ogee = std::abs(std::abs(px) - 0.5f * std::cos(glm::pi<float>() * py) * 0.94f);
        float amount = smooth(0.02f, 0.0f, r - petals) - smooth(0.02f, 0.0f, r - 0.09f);
        amount = std::max(amount, smooth(0.05f, 0.02f, ogee));
        amount = std::max(amount, smooth(0.06f, 0.04f, r));
        glm::vec3 c = glm::mix(ground, figure, amount);
        const float side = std::min(u, 1 - u);
        if (side < 0.06f && side > 0.02f) c = trim;
        const float weave = 0.92f + 0.16f * hash01(int(u * 512), int(v * 512), 11) * 0.5f;
        return opaque(c * weave);
    });
}

TextureImage grassTexture(glm::vec3 colour, int seed) {
    return paintImage("grass", 512, [&](float u, float v) {
        const float patch = fractalNoise(u, v, 5, 5, seed), blade = fractalNoise(u, v, 96, 2, seed + 7);
        const glm::vec3 dry(1.25f, 1.0f, 0.7f);
        return opaque(colour * glm::mix(glm::vec3(1), dry, patch * 0.6f) * (0.45f + 0.6f * patch + 0.5f * blade));
    });
}

TextureImage leafTexture(glm::vec3 colour) {
    return paintImage("leaf", 256, [&](float u, float v) {
        const float t = 1 - v, x = std::abs(2 * u - 1);
        // Outline: widest a third of the way up, with a toothed edge.
        const float width = 0.86f * std::pow(std::sin(glm::pi<float>() * std::pow(std::max(t, 0.0f), 0.7f)), 0.8f);
        const float teeth = 0.07f * std::abs(std::sin(34 * t));
        const bool inside = x < std::max(width - teeth, t < 0.12f ? 0.05f : 0.0f);
        const float rib = smooth(0.03f, 0.0f, x) + 0.6f * smooth(0.25f, 0.0f, std::abs(std::sin(24 * (t - 0.5f * x))));
        const float tone = 0.85f + 0.3f * fractalNoise(u, v, 8, 3, 23);
        return glm::vec4(glm::min(colour * tone * (1 + 0.5f * rib), glm::vec3(0.8f)), inside ? 1 : 0);
    });
}

}  // namespace probegi::builtin
