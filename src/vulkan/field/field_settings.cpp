// The constants by which shaders read a field, and what settings bring besides.
#include <algorithm>

#include "field/guard_number.h"
#include "field/volume_access.h"
#include "kernels/lookup/probe_query.h"
#include "probegi/masks.h"
#include "sdf/sdf_blockers.h"
#include "vulkan/field/field_passes.h"

namespace probegi::vulkan {

kernels::FieldConstants FieldPasses::constants(const FieldSettings& settings) const {
    const auto texelSize = [](const Image& image) {
        return glm::vec2(1.0f / float(image.size().width), 1.0f / float(image.size().height));
    };
    kernels::FieldConstants c{
        .volumeCount = int(m_volumes.size()),
        .guard = guardNumber(settings.guard),
        .rules = m_desc.rules == FieldRules::paper ? kernels::kRulesPaper : kernels::kRulesMeasured,
        .selfShadowBias = settings.selfShadowBias,
        .irradianceTexels = m_desc.irradianceTexels,
        .visibilityTexels = m_desc.visibilityTexels,
        .tiles = m_tiles,
        .irradianceTexelSize = texelSize(m_irradiance),
        .visibilityTexelSize = texelSize(m_visibility),
        .volumes = {},
        .blending = blending(settings),
        .rays = m_rays,
        .masks = packAddress(m_masks.address()),
        .maskTexels = settings.masks ? settings.masks->factor() : 2,
        .maskPacked = settings.masks && settings.masks->packed() ? 1 : 0,
        .blockers = packAddress(m_blockers.address()),
        .blockerCount = int(blockersOf(settings.blockers.get()).size())};
    std::copy(m_volumes.begin(), m_volumes.end(), c.volumes);
    return c;
}

kernels::VolumeBlending FieldPasses::blending(const FieldSettings& settings) const {
    const VolumeOrder order = volumeOrder(m_desc, settings, m_byDensity);
    kernels::VolumeBlending b{.camera = order.camera,
                              .tracking = order.tracking,
                              .outsideRadiance = order.outsideRadiance,
                              .outsideFades = order.outsideFades ? 1 : 0,
                              .order = {}};
    std::copy(m_byDensity.begin(), m_byDensity.end(), b.order);
    return b;
}

// Passes recorded earlier may still read what was there: the caller's barrier orders that. Where there is more, what
// was there stays for these passes; it grows by half, so that little is kept.
void FieldPasses::replace(const Recorder& recorder, Buffer& buffer, const char* name,
                          std::span<const std::byte> bytes) {
    if (buffer.bytes() < bytes.size()) {
        Buffer larger(m_device.impl(), name, std::max(bytes.size(), buffer.bytes() * 3 / 2 / 4 * 4), kAddressed);
        if (buffer) m_earlier.push_back(std::move(buffer));
        buffer = std::move(larger);
    }
    if (!bytes.empty()) recorder.write(buffer, bytes);
}

void FieldPasses::recordBlockers(const Recorder& recorder, const FieldSettings& settings) {
    if (settings.guard != LeakGuard::sdfShadow || settings.blockers == m_recordedBlockers) return;
    replace(recorder, m_blockers, "blockers", std::as_bytes(blockersOf(settings.blockers.get())));
    m_recordedBlockers = settings.blockers;
}

void FieldPasses::recordMasks(const Recorder& recorder, const FieldSettings& settings) {
    if (settings.guard != LeakGuard::masks || settings.masks == m_recordedMasks) return;
    replace(recorder, m_masks, "masks", std::as_bytes(settings.masks->words()));
    m_recordedMasks = settings.masks;
}

void FieldPasses::recordConstants(const Recorder& recorder, const FieldSettings& settings) {
    recordMasks(recorder, settings);
    recordBlockers(recorder, settings);
    recorder.write(m_constants, bytesOf(constants(settings)));
}

void FieldPasses::recordSettings(const Recorder& recorder, const FieldSettings& settings) {
    if (settings == m_recordedSettings) return;
    recorder.orderAll();
    recordConstants(recorder, settings);
    m_recordedSettings = settings;
    recorder.orderAll();
}

}  // namespace probegi::vulkan
