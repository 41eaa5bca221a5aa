#include "vulkan/field/field_mirror.h"

#include <glm/common.hpp>

#include "kernels/probe/irradiance_decoding.h"
#include "kernels/probe/octahedral.h"
#include "kernels/probe/probe_texel.h"

namespace probegi::vulkan {

namespace {

std::size_t texelCount(const Image& image) {
    return std::size_t(image.size().width) * image.size().height * image.layers();
}

void changeLayout(const Recorder& recorder, const Image& image, vk::ImageLayout from, vk::ImageLayout to) {
    const auto access = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
    const vk::ImageMemoryBarrier2 barrier(vk::PipelineStageFlagBits2::eAllCommands, access,
                                          vk::PipelineStageFlagBits2::eAllCommands, access, from, to,
                                          VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image.handle(),
                                          {vk::ImageAspectFlagBits::eColor, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS});
    recorder.commands().pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barrier), recorder.dispatcher());
}

void copyImage(const Recorder& recorder, const Image& image, const Buffer& to) {
    changeLayout(recorder, image, vk::ImageLayout::eGeneral, vk::ImageLayout::eTransferSrcOptimal);
    const vk::BufferImageCopy region(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, image.layers()}, {},
                                     vk::Extent3D(image.size(), 1));
    recorder.commands().copyImageToBuffer(image.handle(), vk::ImageLayout::eTransferSrcOptimal, to.handle(), region,
                                          recorder.dispatcher());
    changeLayout(recorder, image, vk::ImageLayout::eTransferSrcOptimal, vk::ImageLayout::eGeneral);
}

// Bilinear between the four texels around a point in texel units, which lies within the border.
template <class Texel>
auto bilinear(glm::vec2 at, int size, const Texel& texel) {
    const glm::vec2 corner = glm::clamp(glm::floor(at), glm::vec2(-1.0f), glm::vec2(float(size - 1)));
    const glm::vec2 f = at - corner;
    const glm::ivec2 c(corner);
    return glm::mix(glm::mix(texel(c), texel(c + glm::ivec2(1, 0)), f.x),
                    glm::mix(texel(c + glm::ivec2(0, 1)), texel(c + glm::ivec2(1, 1)), f.x), f.y);
}

}  // namespace

FieldMirror::FieldMirror(const FieldPasses& passes) : m_passes(passes), m_desc(passes.desc()) {
    const Device::Impl& device = passes.device().impl();
    const auto readback = [&](std::size_t bytes) {
        return Buffer(device, "mirror", bytes, vk::BufferUsageFlagBits::eTransferDst, MemoryUse::readback);
    };
    const std::size_t irradianceTexels = texelCount(passes.irradiance());
    const std::size_t visibilityTexels = texelCount(passes.visibility());
    const Buffer irradiance = readback(irradianceTexels * 8), visibility = readback(visibilityTexels * 4);
    const Buffer states = readback(passes.states().bytes());
    submitAndWait(passes.device(), [&](const Recorder& recorder) {
        copyImage(recorder, passes.irradiance(), irradiance);
        copyImage(recorder, passes.visibility(), visibility);
        recorder.orderAll();
        recorder.copy(passes.states(), states, passes.states().bytes());
        recorder.transferToHost();
    });
    const auto halves = irradiance.mapped<std::uint16_t>();
    m_irradiance.assign(halves.begin(), halves.begin() + std::ptrdiff_t(4 * irradianceTexels));
    const auto moments = visibility.mapped<std::uint32_t>();
    m_visibility.assign(moments.begin(), moments.begin() + std::ptrdiff_t(visibilityTexels));
    m_fallbacks = states.mapped<std::uint32_t>()[0];
    const auto shares = states.mapped<float>().subspan(1, passes.layout().probes);
    m_shares.assign(shares.begin(), shares.end());
}

std::size_t FieldMirror::texelIndex(const Image& image, int texels, int probe, glm::ivec2 texel) const {
    const glm::ivec3 tile = kernels::poolTile(m_passes.tiles(), probe);
    const glm::ivec2 at = kernels::tileOrigin(tile, texels) + texel;
    return (std::size_t(tile.z) * image.size().height + std::size_t(at.y)) * image.size().width + std::size_t(at.x);
}

glm::vec3 FieldMirror::irradianceTexel(int probe, glm::ivec2 texel) const {
    const std::uint16_t* halves =
        m_irradiance.data() + 4 * texelIndex(m_passes.irradiance(), m_desc.irradianceTexels, probe, texel);
    return {kernels::unpackHalf(halves[0]), kernels::unpackHalf(halves[1]), kernels::unpackHalf(halves[2])};
}

glm::vec2 FieldMirror::visibilityTexel(int probe, glm::ivec2 texel) const {
    return kernels::unpackMoments(
        m_visibility[texelIndex(m_passes.visibility(), m_desc.visibilityTexels, probe, texel)]);
}

glm::vec3 FieldMirror::probeIrradiance(int probe, glm::vec3 normal) const {
    const int size = m_desc.irradianceTexels;
    const glm::vec3 stored = bilinear(kernels::octTexelPosition(kernels::octEncode(normal), size), size,
                                      [&](glm::ivec2 texel) { return irradianceTexel(probe, texel); });
    return kernels::kPi * glm::vec3(kernels::decodeIrradiance(stored.x), kernels::decodeIrradiance(stored.y),
                                    kernels::decodeIrradiance(stored.z));
}

glm::vec2 FieldMirror::probeDistanceMoments(int probe, glm::vec3 direction) const {
    const int size = m_desc.visibilityTexels;
    const float d = m_passes.volumes()[volumeOf(m_passes.volumes(), probe)].maxDistance;
    return bilinear(kernels::octTexelPosition(kernels::octEncode(direction), size), size,
                    [&](glm::ivec2 texel) { return visibilityTexel(probe, texel); }) *
           glm::vec2(d, d * d);
}

std::vector<float> FieldMirror::brightness() const {
    const int size = m_desc.irradianceTexels;
    std::vector<float> result(m_passes.layout().probes);
    for (std::size_t probe = 0; probe < result.size(); ++probe) {
        float sum = 0;
        for (int t = 0; t < size * size; ++t) {
            const glm::vec3 stored = irradianceTexel(int(probe), {t % size, t / size});
            for (int c = 0; c < 3; ++c) sum += kernels::decodeIrradiance(stored[c]);
        }
        result[probe] = sum / float(3 * size * size);
    }
    return result;
}

}  // namespace probegi::vulkan
