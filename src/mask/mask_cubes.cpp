#include "mask/mask_cubes.h"

#include <string_view>
#include <unordered_map>

namespace probegi {

namespace {

/// Appends a cube's texels to the words.
void append(std::span<const std::uint32_t> cube, bool packed, std::vector<std::uint32_t>& words) {
    if (!packed) {
        words.insert(words.end(), cube.begin(), cube.end());
        return;
    }
    for (std::size_t t = 0; t < cube.size(); t += 2)
        words.push_back((cube[t] & 0xffffu) | (t + 1 < cube.size() ? cube[t + 1] << 16 : 0u));
}

}  // namespace

MaskCubes mergeCubes(std::span<const std::uint32_t> texels, int factor, bool packed) {
    const std::size_t perCube = std::size_t(factor) * std::size_t(factor) * std::size_t(factor);
    MaskCubes cubes;
    cubes.cubeWords = packed ? (perCube + 1) / 2 : perCube;
    const std::vector<std::uint32_t> open(perCube, kOpenTexel);
    std::unordered_map<std::string_view, std::uint32_t> known;
    const auto add = [&](std::span<const std::uint32_t> cube) {
        const std::string_view key(reinterpret_cast<const char*>(cube.data()), cube.size_bytes());
        const auto [entry, isNew] = known.try_emplace(key, std::uint32_t(known.size()));
        cubes.of.push_back(entry->second);
        if (isNew) append(cube, packed, cubes.words);
    };
    for (std::size_t at = 0; at < texels.size(); at += perCube) add(texels.subspan(at, perCube));
    add(open);
    return cubes;
}

}  // namespace probegi
