#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "probegi/context.h"
#include "probegi/scene.h"

namespace probegi {

/// What a texel's channels are, and so what their mean is.
enum class TexelKind : std::uint8_t {
    color,  ///< sRGB: the mean of the light that they stand for
    data,   ///< the mean of the numbers
};

/// Levels 1 and up of an image, RGBA8 like level 0, one after the other: each texel the mean of what it covers on the
/// level below. Empty for an image of one texel.
std::vector<std::uint8_t> makeMips(const TextureImage& image, TexelKind kind);

/// The coarser levels of all images that a scene's materials use.
class MipMaps {
public:
    /// None: look-ups stay on level 0.
    MipMaps() = default;
    /// On the context's threads. The scene must be valid; it is read during the call only.
    MipMaps(const Context& context, const Scene& scene);

    /// Empty where no material uses the image so. Valid for the life of the object.
    std::span<const std::uint8_t> of(int image, TexelKind kind) const noexcept;

private:
    std::map<std::pair<int, TexelKind>, std::vector<std::uint8_t>> m_levels;
};

}  // namespace probegi
