#pragma once

#include "mask/mask_texels.h"

namespace probegi {

/// Texel words of kernels/guards/masks.h, a cube each, every one different (section 3.4.2).
struct MaskCubes {
    std::vector<std::uint32_t> words;
    std::vector<std::uint32_t> of;  ///< by blocked cell: its cube; the last is that of all other cells, which see all
    std::size_t cubeWords = 0;
    std::size_t count() const noexcept { return words.size() / cubeWords; }
};

/// Merges equal cubes of texels [cell][texel]; they are numbered in the order of their first cells, that which sees all
/// last if it is new. `packed`: two texels to a word, without their upper halves.
MaskCubes mergeCubes(std::span<const std::uint32_t> texels, int factor, bool packed);

}  // namespace probegi
