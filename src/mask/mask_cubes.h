#pragma once

#include <unordered_map>

#include "mask/mask_texels.h"

namespace probegi {

/// Texel words of kernels/guards/masks.h, a cube each, every one different (section 3.4.2). Cells share them: a cube
/// that no cell has any more gives its place to the next new one.
class MaskCubes {
public:
    /// `packed`: two texels to a word, without their upper halves.
    MaskCubes(int factor, bool packed);

    /// The number of the cube of these texels; it counts one cell more.
    std::uint32_t add(std::span<const std::uint32_t> texels);
    /// A cell less has this cube.
    void release(std::uint32_t cube);

    std::span<const std::uint32_t> words() const noexcept { return m_words; }
    std::size_t cubeWords() const noexcept { return m_cubeWords; }
    std::size_t count() const noexcept { return m_cells.size() - m_free.size(); }  ///< cubes that cells have

private:
    void pack(std::span<const std::uint32_t> texels);
    std::span<std::uint32_t> wordsOf(std::uint32_t cube) {
        return std::span(m_words).subspan(cube * m_cubeWords, m_cubeWords);
    }
    std::uint32_t place();

    bool m_packed;
    std::size_t m_cubeWords;
    std::vector<std::uint32_t> m_words;
    std::vector<std::uint32_t> m_cells;  // by cube: how many have it
    std::vector<std::uint32_t> m_free;
    std::vector<std::uint32_t> m_cube;  // that of the last add()
    std::unordered_multimap<std::size_t, std::uint32_t> m_byHash;
};

}  // namespace probegi
