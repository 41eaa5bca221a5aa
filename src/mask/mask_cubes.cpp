#include "mask/mask_cubes.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <unordered_map>

namespace probegi {

MaskCubes mergeCubes(std::span<const std::uint8_t> masks, int factor) {
    const std::size_t texels = std::size_t(factor) * std::size_t(factor) * std::size_t(factor);
    MaskCubes cubes;
    cubes.cubeWords = (texels + 3) / 4;
    const std::vector<std::uint8_t> open(texels, 255);
    std::unordered_map<std::string_view, std::uint32_t> known;
    const auto add = [&](const std::uint8_t* cube) {
        const std::string_view key(reinterpret_cast<const char*>(cube), texels);
        const auto [entry, isNew] = known.try_emplace(key, std::uint32_t(known.size()));
        cubes.of.push_back(entry->second);
        if (!isNew) return;
        const std::size_t first = cubes.words.size();
        cubes.words.resize(first + cubes.cubeWords, 0);
        for (std::size_t t = 0; t < texels; ++t) cubes.words[first + t / 4] |= std::uint32_t(cube[t]) << (8 * (t % 4));
    };
    for (std::size_t c = 0; c < masks.size() / texels; ++c) add(masks.data() + c * texels);
    add(open.data());
    return cubes;
}

}  // namespace probegi
