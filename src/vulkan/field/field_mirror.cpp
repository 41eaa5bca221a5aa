#include "vulkan/field/field_mirror.h"

#include <algorithm>
#include <cstring>

#include "field/snapshot.h"
#include "kernels/probe/irradiance_decoding.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/storage.h"

namespace probegi::vulkan {

namespace {

constexpr std::size_t kHalvesOfTexel = 4;  // the fourth is unused

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

vk::BufferImageCopy wholeImage(const Image& image) {
    return {0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, image.layers()}, {}, vk::Extent3D(image.size(), 1)};
}

void copyImage(const Recorder& recorder, const Image& image, const Buffer& to) {
    changeLayout(recorder, image, vk::ImageLayout::eGeneral, vk::ImageLayout::eTransferSrcOptimal);
    recorder.commands().copyImageToBuffer(image.handle(), vk::ImageLayout::eTransferSrcOptimal, to.handle(),
                                          wholeImage(image), recorder.dispatcher());
    changeLayout(recorder, image, vk::ImageLayout::eTransferSrcOptimal, vk::ImageLayout::eGeneral);
}

void copyImage(const Recorder& recorder, const Buffer& from, const Image& image) {
    changeLayout(recorder, image, vk::ImageLayout::eGeneral, vk::ImageLayout::eTransferDstOptimal);
    recorder.commands().copyBufferToImage(from.handle(), image.handle(), vk::ImageLayout::eTransferDstOptimal,
                                          wholeImage(image), recorder.dispatcher());
    changeLayout(recorder, image, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eGeneral);
}

template <class T>
std::vector<T> contents(const Buffer& buffer, std::size_t first, std::size_t count) {
    const auto values = buffer.mapped<T>().subspan(first, count);
    return {values.begin(), values.end()};
}

template <class T>
Buffer uploadBuffer(const Device& device, const std::vector<T>& values) {
    Buffer buffer(device.impl(), "mirror", values.size() * sizeof(T), vk::BufferUsageFlagBits::eTransferSrc,
                  MemoryUse::upload);
    std::copy(values.begin(), values.end(), buffer.mapped<T>().begin());
    return buffer;
}

}  // namespace

FieldMirror::FieldMirror(const FieldPasses& passes) : m_passes(passes), m_desc(passes.desc()) {
    const auto readback = [&](std::size_t bytes) {
        return Buffer(passes.device().impl(), "mirror", bytes, vk::BufferUsageFlagBits::eTransferDst,
                      MemoryUse::readback);
    };
    const std::size_t probes = passes.layout().probes;
    const std::size_t irradianceTexels = texelCount(passes.irradiance());
    const std::size_t visibilityTexels = texelCount(passes.visibility());
    const Buffer irradiance = readback(irradianceTexels * 2 * kHalvesOfTexel),
                 visibility = readback(visibilityTexels * 4);
    const Buffer states = readback(passes.states().bytes()), sides = readback(passes.sides().bytes()),
                 filters = readback(passes.filters().bytes());
    submitAndWait(passes.device(), [&](const Recorder& recorder) {
        copyImage(recorder, passes.irradiance(), irradiance);
        copyImage(recorder, passes.visibility(), visibility);
        recorder.orderAll();
        recorder.copy(passes.states(), states, states.bytes());
        recorder.copy(passes.sides(), sides, sides.bytes());
        recorder.copy(passes.filters(), filters, filters.bytes());
        recorder.transferToHost();
    });
    m_irradiance = contents<std::uint16_t>(irradiance, 0, kHalvesOfTexel * irradianceTexels);
    m_visibility = contents<std::uint32_t>(visibility, 0, visibilityTexels);
    // After the count of fallbacks, which is as long as one of the members.
    const auto words = contents<std::uint32_t>(states, 1, 2 * probes);
    m_statuses.resize(probes);
    std::memcpy(m_statuses.data(), words.data(), words.size() * sizeof(words[0]));
    m_sides = contents<kernels::ProbeSides>(sides, 0, probes);
    m_filters = contents<kernels::PackedProbeFilter>(filters, 0, probes);
}

std::size_t FieldMirror::texelIndex(const Image& image, int texels, int slot, glm::ivec2 texel) const {
    const glm::ivec3 tile = kernels::poolTile(m_passes.tiles(), slot);
    const glm::ivec2 at = kernels::tileOrigin(tile, texels) + texel;
    return (std::size_t(tile.z) * image.size().height + std::size_t(at.y)) * image.size().width + std::size_t(at.x);
}

void FieldMirror::readMaps(FieldSnapshot& snapshot, std::size_t probe, int slot) const {
    const int irradianceSide = m_desc.irradianceTexels, visibilitySide = m_desc.visibilityTexels;
    std::uint16_t* halves = snapshot.irradiance.data() + probe * 3 * m_passes.layout().irradianceTexels;
    for (int y = 0; y < irradianceSide; ++y)
        for (int x = 0; x < irradianceSide; ++x) {
            const std::size_t from = texelIndex(m_passes.irradiance(), irradianceSide, slot, {x, y});
            halves = std::copy_n(m_irradiance.data() + kHalvesOfTexel * from, 3, halves);
        }
    std::uint32_t* moments = snapshot.visibility.data() + probe * m_passes.layout().visibilityTexels;
    for (int y = 0; y < visibilitySide; ++y)
        moments = std::copy_n(m_visibility.data() + texelIndex(m_passes.visibility(), visibilitySide, slot, {0, y}),
                              visibilitySide, moments);
}

void FieldMirror::writeMaps(const FieldSnapshot& snapshot, std::size_t probe, int slot) {
    const auto forEachTexel = [](int side, const auto& body) {
        for (int y = -1; y <= side; ++y)
            for (int x = -1; x <= side; ++x) {
                const glm::ivec2 inside = kernels::octWrapTexel(x, y, side);
                body(glm::ivec2(x, y), std::size_t(inside.y * side + inside.x));
            }
    };
    const std::uint16_t* halves = snapshot.irradiance.data() + probe * 3 * m_passes.layout().irradianceTexels;
    forEachTexel(m_desc.irradianceTexels, [&](glm::ivec2 texel, std::size_t from) {
        const std::size_t to = texelIndex(m_passes.irradiance(), m_desc.irradianceTexels, slot, texel);
        std::copy_n(halves + 3 * from, 3, m_irradiance.data() + kHalvesOfTexel * to);
    });
    const std::uint32_t* moments = snapshot.visibility.data() + probe * m_passes.layout().visibilityTexels;
    forEachTexel(m_desc.visibilityTexels, [&](glm::ivec2 texel, std::size_t from) {
        m_visibility[texelIndex(m_passes.visibility(), m_desc.visibilityTexels, slot, texel)] = moments[from];
    });
}

FieldSnapshot FieldMirror::read(SlotRange slots) const {
    FieldSnapshot snapshot = emptySnapshot(m_desc, slots);
    for (std::size_t i = 0; i < snapshot.states.size(); ++i) {
        const std::size_t slot = std::size_t(slots.first) + i;
        readMaps(snapshot, i, int(slot));
        snapshot.states[i] = probeState(m_statuses[slot].backfaceShare, m_sides[slot], m_filters[slot]);
    }
    return snapshot;
}

void FieldMirror::write(const FieldSnapshot& snapshot) {
    for (std::size_t i = 0; i < snapshot.states.size(); ++i) {
        const std::size_t slot = std::size_t(snapshot.slots.first) + i;
        writeMaps(snapshot, i, int(slot));
        m_statuses[slot] = {snapshot.states[i].backfaceShare, snapshot.states[i].placement};
        m_sides[slot] = sidesOf(snapshot.states[i]);
        m_filters[slot] = filterOf(snapshot.states[i]);
    }
    upload();
}

void FieldMirror::upload() const {
    const Device& device = m_passes.device();
    const Buffer irradiance = uploadBuffer(device, m_irradiance), visibility = uploadBuffer(device, m_visibility);
    const Buffer statuses = uploadBuffer(device, m_statuses), sides = uploadBuffer(device, m_sides),
                 filters = uploadBuffer(device, m_filters);
    submitAndWait(device, [&](const Recorder& recorder) {
        recorder.orderAll();
        copyImage(recorder, irradiance, m_passes.irradiance());
        copyImage(recorder, visibility, m_passes.visibility());
        recorder.copy(statuses, m_passes.states(), statuses.bytes(), sizeof(std::uint32_t));
        recorder.copy(sides, m_passes.sides(), sides.bytes());
        recorder.copy(filters, m_passes.filters(), filters.bytes());
        recorder.orderAll();
    });
}

ProbeLight FieldMirror::light() const {
    const int side = m_desc.irradianceTexels;
    ProbeLight light{std::vector<float>(m_statuses.size()), std::vector<float>(m_statuses.size())};
    for (std::size_t probe = 0; probe < m_statuses.size(); ++probe) {
        light.backfaceShares[probe] = m_statuses[probe].backfaceShare;
        float sum = 0;
        for (int t = 0; t < side * side; ++t) {
            const std::size_t texel = texelIndex(m_passes.irradiance(), side, int(probe), {t % side, t / side});
            for (std::size_t c = 0; c < 3; ++c)
                sum += kernels::decodeIrradiance(kernels::unpackHalf(m_irradiance[kHalvesOfTexel * texel + c]));
        }
        light.brightness[probe] = sum / float(3 * side * side);
    }
    return light;
}

}  // namespace probegi::vulkan
