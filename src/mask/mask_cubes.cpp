#include "mask/mask_cubes.h"

#include <algorithm>
#include <string_view>

namespace probegi {

namespace {

std::size_t hashOf(std::span<const std::uint32_t> words) {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(words.data()), words.size_bytes()});
}

}  // namespace

MaskCubes::MaskCubes(int factor, bool packed) : m_packed(packed) {
    const std::size_t texels = std::size_t(factor) * std::size_t(factor) * std::size_t(factor);
    m_cubeWords = packed ? (texels + 1) / 2 : texels;
}

void MaskCubes::pack(std::span<const std::uint32_t> texels) {
    if (!m_packed) return m_cube.assign(texels.begin(), texels.end());
    m_cube.clear();
    for (std::size_t t = 0; t < texels.size(); t += 2)
        m_cube.push_back((texels[t] & 0xffffu) | (t + 1 < texels.size() ? texels[t + 1] << 16 : 0u));
}

std::uint32_t MaskCubes::place() {
    if (m_free.empty()) {
        m_words.resize(m_words.size() + m_cubeWords);
        m_cells.push_back(0);
        return std::uint32_t(m_cells.size() - 1);
    }
    const std::uint32_t cube = m_free.back();
    m_free.pop_back();
    return cube;
}

std::uint32_t MaskCubes::add(std::span<const std::uint32_t> texels) {
    pack(texels);
    const std::size_t hash = hashOf(m_cube);
    const auto [begin, end] = m_byHash.equal_range(hash);
    for (auto known = begin; known != end; ++known)
        if (std::ranges::equal(wordsOf(known->second), m_cube)) {
            ++m_cells[known->second];
            return known->second;
        }
    const std::uint32_t cube = place();
    std::ranges::copy(m_cube, wordsOf(cube).begin());
    m_cells[cube] = 1;
    m_byHash.emplace(hash, cube);
    return cube;
}

void MaskCubes::release(std::uint32_t cube) {
    if (--m_cells[cube] > 0) return;
    const auto [begin, end] = m_byHash.equal_range(hashOf(wordsOf(cube)));
    m_byHash.erase(std::find_if(begin, end, [&](const auto& known) { return known.second == cube; }));
    m_free.push_back(cube);
}

}  // namespace probegi
