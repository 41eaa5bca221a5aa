#include "surface/mip_maps.h"

#include <new>

#include "core/parallel.h"
#include "kernels/texture.h"

#define STB_IMAGE_RESIZE_IMPLEMENTATION
#define STB_IMAGE_RESIZE_STATIC
#include <stb_image_resize.h>

namespace probegi {

namespace {

void halve(const std::uint8_t* from, int width, int height, std::uint8_t* to, int toWidth, int toHeight,
           TexelKind kind) {
    // All four channels apart: a look-up of colour does not ask for alpha, so neither may its mean.
    const stbir_colorspace space = kind == TexelKind::color ? STBIR_COLORSPACE_SRGB : STBIR_COLORSPACE_LINEAR;
    if (!stbir_resize_uint8_generic(from, width, height, 0, to, toWidth, toHeight, 0, 4, STBIR_ALPHA_CHANNEL_NONE, 0,
                                    STBIR_EDGE_CLAMP, STBIR_FILTER_BOX, space, nullptr))
        throw std::bad_alloc();
}

}  // namespace

std::vector<std::uint8_t> makeMips(const TextureImage& image, TexelKind kind) {
    const int levels = kernels::mipLevels(image.width, image.height);
    std::vector<std::uint8_t> mips(4 * std::size_t(kernels::mipOffset(image.width, image.height, levels)));
    const std::uint8_t* from = image.rgba.data();
    for (int level = 1; level < levels; ++level) {
        std::uint8_t* to = mips.data() + 4 * std::size_t(kernels::mipOffset(image.width, image.height, level));
        halve(from, kernels::mipSize(image.width, level - 1), kernels::mipSize(image.height, level - 1), to,
              kernels::mipSize(image.width, level), kernels::mipSize(image.height, level), kind);
        from = to;
    }
    return mips;
}

MipMaps::MipMaps(const Context& context, const Scene& scene) {
    const auto use = [&](const TextureRef& ref, TexelKind kind) {
        if (ref.image >= 0) m_levels.try_emplace({ref.image, kind});
    };
    for (const Material& material : scene.materials) {
        use(material.baseColorTexture, TexelKind::color);
        use(material.emissiveTexture, TexelKind::color);
        use(material.metallicRoughnessTexture, TexelKind::data);
        use(material.normalTexture, TexelKind::data);
    }
    std::vector<std::pair<const std::pair<int, TexelKind>, std::vector<std::uint8_t>>*> jobs;
    for (auto& entry : m_levels) jobs.push_back(&entry);
    parallelFor(context, jobs.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            jobs[i]->second = makeMips(scene.images[std::size_t(jobs[i]->first.first)], jobs[i]->first.second);
    });
}

std::span<const std::uint8_t> MipMaps::of(int image, TexelKind kind) const noexcept {
    const auto found = m_levels.find({image, kind});
    return found == m_levels.end() ? std::span<const std::uint8_t>() : found->second;
}

}  // namespace probegi
