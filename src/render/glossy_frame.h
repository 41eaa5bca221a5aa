#pragma once

#include <vector>

#include "kernels/screen/glossy_ray.h"
#include "render/frame.h"

namespace probegi {

/// What the passes of PictureDesc::glossy keep of one plane of a frame. Blocks are 2 x 2 pixels, counted from the
/// frame's top left corner; those at the right and lower edge may be cut.
class GlossyFrame {
public:
    /// The frame is now there. Nothing is initialised: glossyTrace writes all.
    void place(const PixelRect& rect) {
        m_rect = rect;
        m_blocks = {0, 0, kernels::glossyBlocks(rect.width), kernels::glossyBlocks(rect.height)};
        hits.place(m_blocks, 0, 1);
        m_samples.resize(m_blocks.pixels());
        m_lobes.resize(rect.pixels());
    }

    /// All blocks, as if they were pixels of a picture of their own.
    const PixelRect& blocks() const noexcept { return m_blocks; }
    /// Blocks of a part of the frame that begins at one.
    PixelRect blocksOf(const PixelRect& part) const noexcept {
        return {(part.x - m_rect.x) / 2, (part.y - m_rect.y) / 2, kernels::glossyBlocks(part.width),
                kernels::glossyBlocks(part.height)};
    }
    bool contains(int column, int row) const noexcept {
        return column >= 0 && row >= 0 && column < m_blocks.width && row < m_blocks.height;
    }

    kernels::GlossySample& sample(int column, int row) noexcept {
        return m_samples[std::size_t(row) * std::size_t(m_blocks.width) + std::size_t(column)];
    }
    /// Of a pixel of the picture: E / pi in the mirror direction where rough surfaces need it, then the light of the
    /// glossy lobe.
    glm::vec3& lobe(int x, int y) noexcept {
        return m_lobes[std::size_t(y - m_rect.y) * std::size_t(m_rect.width) + std::size_t(x - m_rect.x)];
    }
    /// Number of a pixel, as in GlossySample.
    int pixel(int x, int y) const noexcept { return (y - m_rect.y) * m_rect.width + (x - m_rect.x); }
    int pixelX(int pixel) const noexcept { return m_rect.x + pixel % m_rect.width; }
    int pixelY(int pixel) const noexcept { return m_rect.y + pixel / m_rect.width; }

    Frame hits;  ///< what the rays met; of blocks without a ray: sky, black

private:
    PixelRect m_rect, m_blocks;
    std::vector<kernels::GlossySample> m_samples;
    std::vector<glm::vec3> m_lobes;
};

/// The material of a sample, as pictures with all lobes have it.
inline kernels::Bsdf materialOf(const ScreenSample& sample) {
    return kernels::makeBsdf(sample.albedo, sample.metallic, sample.roughness, false);
}

}  // namespace probegi
