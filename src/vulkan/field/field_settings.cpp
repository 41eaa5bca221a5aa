// The constants by which shaders read a field, and what settings bring besides.
#include "field/guard_number.h"
#include "field/volume_access.h"
#include "kernels/lookup/probe_query.h"
#include "probegi/masks.h"
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
        .maskPacked = settings.masks && settings.masks->packed() ? 1 : 0};
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

// Earlier passes with other masks have run: fields whose passes are only recorded have none (GpuField).
void FieldPasses::recordConstants(const Recorder& recorder, const FieldSettings& settings) {
    if (settings.guard == LeakGuard::masks && settings.masks != m_recordedMasks) {
        const auto words = std::as_bytes(settings.masks->words());
        m_masks = Buffer(m_device.impl(), "masks", words.size(), kAddressed);
        recorder.write(m_masks, words);
        m_recordedMasks = settings.masks;
    }
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
