#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "probegi/context.h"
#include "probegi/scene.h"

namespace probegi {

/// Meaning of a texel's channels, which determines how they are averaged.
enum class TexelKind : std::uint8_t {
    color,  ///< sRGB: averaged in linear light
    data,   ///< averaged as stored
};

/// Levels 1 and up of an image, consecutively, RGBA8 like level 0: each texel is the mean of what it covers on the
/// finer level. Empty for an image of one texel.
std::vector<std::uint8_t> makeMips(const TextureImage& image, TexelKind kind);

/// The coarser levels of all images that a scene's materials use.
class MipMaps {
public:
    /// No mips: look-ups use level 0.
    MipMaps() = default;
    /// On the context's threads. The scene must be valid; it is read during the call only.
    MipMaps(const Context& context, const Scene& scene);

    /// Empty if no material uses the image this way. Valid for the lifetime of the object.
    std::span<const std::uint8_t> of(int image, TexelKind kind) const noexcept;

private:
    std::map<std::pair<int, TexelKind>, std::vector<std::uint8_t>> m_levels;
};

}  // namespace probegi
