#include <limits>

#include "core/sentence.h"
#include "field/probe_emitters.h"
#include "kernels/abi/gpu_passes.h"
#include "kernels/lookup/probe_query.h"
#include "kernels/probe/solid_probe.h"
#include "vulkan/device/errors.h"
#include "vulkan/field/probe_volume_impl.h"
#include "vulkan/scene/gpu_lighting_impl.h"
#include "vulkan/scene/gpu_scene_impl.h"

namespace probegi::vulkan {

namespace {

// Specialisation constants of blend_irradiance.comp.
std::array<std::uint32_t, 1> irradianceConstants(const FieldDesc& desc) {
    return {desc.backfaceRule == BackfaceRule::excluded ? 1u : 0u};
}

std::uint32_t groups(std::size_t count, int size) {
    return std::uint32_t((count + std::size_t(size) - 1) / std::size_t(size));
}

// An atlas for maps of `texels` a side: a layer for each z, tiles with borders.
Image makeAtlas(const Device& device, const char* name, vk::Format format, glm::ivec3 counts, int texels) {
    const auto& limits = device.impl().limits;
    const std::int64_t tile = texels + 2;
    if (counts.x * tile > limits.maxImageDimension2D || counts.y * tile > limits.maxImageDimension2D)
        throw Failure(ErrorCode::unsupported,
                      sentence(counts.x, "x", counts.y,
                               " probes along x and y do not fit into this device's images; with maps of ", texels,
                               " texels each axis may have ", limits.maxImageDimension2D / tile));
    if (std::uint32_t(counts.z) > limits.maxImageArrayLayers)
        throw Failure(ErrorCode::unsupported,
                      sentence(counts.z, " probes along z do not fit into this device's images; it has ",
                               limits.maxImageArrayLayers, " layers"));
    return {device.impl(),
            name,
            format,
            {std::uint32_t(counts.x * tile), std::uint32_t(counts.y * tile)},
            std::uint32_t(counts.z)};
}

// Shaders count rays and their buffers' entries in 31 bits.
FieldLayout checkedLayout(const FieldDesc& desc) {
    const FieldLayout layout(desc);
    constexpr std::size_t kMost = std::size_t(std::numeric_limits<std::int32_t>::max());
    if (layout.probes * layout.rays > kMost)
        throw Failure(ErrorCode::unsupported, sentence(layout.probes, " probes with ", layout.rays,
                                                       " rays each are more rays than the GPU backend counts, ", kMost,
                                                       "; use fewer probes or raysPerProbe"));
    return layout;
}

}  // namespace

VolumePasses::VolumePasses(const Device& device, const FieldDesc& desc)
    : m_device(device),
      m_desc(desc),
      m_layout(checkedLayout(desc)),
      m_irradiance(makeAtlas(device, "irradiance", kIrradianceFormat, desc.grid.counts, desc.irradianceTexels)),
      m_visibility(makeAtlas(device, "visibility", kVisibilityFormat, desc.grid.counts, desc.visibilityTexels)),
      m_constants(device.impl(), "volume constants", sizeof(kernels::GpuVolume),
                  vk::BufferUsageFlagBits::eUniformBuffer | vk::BufferUsageFlagBits::eTransferDst),
      m_states(device.impl(), "probe states", sizeof(std::uint32_t) + m_layout.probes * sizeof(float),
               vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst |
                   vk::BufferUsageFlagBits::eTransferSrc),
      m_sides(device.impl(), "probe sides", m_layout.probes * sizeof(kernels::ProbeSides),
              kAddressed | vk::BufferUsageFlagBits::eTransferDst),
      m_filters(device.impl(), "temporal filters", m_layout.probes * sizeof(kernels::PackedProbeFilter),
                kAddressed | vk::BufferUsageFlagBits::eTransferDst),
      m_steps(device.impl(), "temporal steps", m_layout.probes * sizeof(kernels::GpuProbeStep), kAddressed),
      m_changes(device.impl(), "texel changes",
                m_layout.probes * groups(m_layout.irradianceTexels, kernels::kIrradianceGroupTexels) *
                    sizeof(kernels::TexelChange),
                kAddressed),
      m_directions(device.impl(), "ray directions", (m_layout.rays + std::size_t(desc.fixedRays)) * sizeof(glm::vec3),
                   kAddressed),
      m_irradianceWeights(device.impl(), "irradiance weights",
                          m_layout.rays * m_layout.irradianceTexels * sizeof(float), kAddressed),
      m_visibilityRays(device.impl(), "rays of visibility texels",
                       m_layout.visibilityTexels * sizeof(kernels::GpuTexelRays), kAddressed),
      m_visibilityWeights(device.impl(), "visibility weights",
                          m_layout.rays * m_layout.visibilityTexels * sizeof(kernels::GpuRayWeight), kAddressed) {
    writeSet();
}

kernels::GpuVolume VolumePasses::constants(LeakGuard guard) const {
    const GridDesc& grid = m_desc.grid;
    const auto texelSize = [](const Image& image) {
        return glm::vec2(1.0f / float(image.size().width), 1.0f / float(image.size().height));
    };
    return {.origin = grid.origin,
            .minSpacing = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z}),
            .spacing = grid.spacing,
            .selfShadowBias = m_desc.selfShadowBias,
            .inverseSpacing = 1.0f / grid.spacing,
            .inverseMaxDistance = 1.0f / m_layout.maxDistance,
            .counts = grid.counts,
            .guard = guard == LeakGuard::none ? kernels::kGuardNone : kernels::kGuardMoments,
            .irradianceTexelSize = texelSize(m_irradiance),
            .visibilityTexelSize = texelSize(m_visibility),
            .irradianceTexels = m_desc.irradianceTexels,
            .visibilityTexels = m_desc.visibilityTexels,
            .rules = m_desc.rules == FieldRules::paper ? kernels::kRulesPaper : kernels::kRulesMeasured};
}

void VolumePasses::writeSet() {
    const Device::Impl& device = m_device.impl();
    const vk::DescriptorPoolSize sizes[] = {{vk::DescriptorType::eUniformBuffer, 1},
                                            {vk::DescriptorType::eCombinedImageSampler, 2},
                                            {vk::DescriptorType::eStorageBuffer, 1},
                                            {vk::DescriptorType::eStorageImage, 2}};
    m_pool = vk::raii::DescriptorPool(
        device.device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes));
    m_sets = vk::raii::DescriptorSets(device.device,
                                      vk::DescriptorSetAllocateInfo(*m_pool, *device.pipelines->layout().volume));
    writeQueryBindings(set(), 0);
    const vk::DescriptorImageInfo images[] = {{{}, m_irradiance.view(), vk::ImageLayout::eGeneral},
                                              {{}, m_visibility.view(), vk::ImageLayout::eGeneral}};
    device.device.updateDescriptorSets(
        vk::WriteDescriptorSet(set(), 4, 0, 1, vk::DescriptorType::eStorageImage, &images[0]), {});
    device.device.updateDescriptorSets(
        vk::WriteDescriptorSet(set(), 5, 0, 1, vk::DescriptorType::eStorageImage, &images[1]), {});
}

void VolumePasses::writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding) const {
    const Device::Impl& device = m_device.impl();
    const vk::Sampler sampler = *device.pipelines->layout().sampler;
    const vk::DescriptorBufferInfo constants(m_constants.handle(), 0, VK_WHOLE_SIZE);
    const vk::DescriptorBufferInfo states(m_states.handle(), 0, VK_WHOLE_SIZE);
    const vk::DescriptorImageInfo images[] = {{sampler, m_irradiance.view(), vk::ImageLayout::eGeneral},
                                              {sampler, m_visibility.view(), vk::ImageLayout::eGeneral}};
    using Type = vk::DescriptorType;
    const vk::WriteDescriptorSet writes[] = {{set, firstBinding, 0, 1, Type::eUniformBuffer, nullptr, &constants},
                                             {set, firstBinding + 1, 0, 1, Type::eCombinedImageSampler, &images[0]},
                                             {set, firstBinding + 2, 0, 1, Type::eCombinedImageSampler, &images[1]},
                                             {set, firstBinding + 3, 0, 1, Type::eStorageBuffer, nullptr, &states}};
    device.device.updateDescriptorSets(writes, {});
}

FieldMemory VolumePasses::memory() const noexcept {
    return {m_irradiance.bytes(), m_visibility.bytes(),
            m_states.bytes() + m_sides.bytes() + m_filters.bytes() + m_constants.bytes() + m_directions.bytes(),
            m_irradianceWeights.bytes() + m_visibilityRays.bytes() + m_visibilityWeights.bytes() + m_hits.bytes() +
                m_rayData.bytes() + m_fixedRays.bytes() + m_emitterLights.bytes() + m_steps.bytes() +
                m_changes.bytes()};
}

void VolumePasses::makeRayBuffers(int looks) {
    if (looks > 0 && !m_emitterLights)
        m_emitterLights = Buffer(m_device.impl(), "emitter lights",
                                 m_layout.probes * std::size_t(looks) * sizeof(kernels::EmitterLight), kAddressed);
    if (m_rayData) return;
    const std::size_t rays = m_layout.probes * m_layout.rays, fixed = m_layout.probes * std::size_t(m_desc.fixedRays);
    Buffer hits(m_device.impl(), "probe ray hits", (rays + fixed) * sizeof(Hit), kAddressed);
    Buffer fixedRays(m_device.impl(), "fixed ray data", std::max(fixed, std::size_t(1)) * sizeof(FixedRayDatum),
                     kAddressed);
    m_rayData = Buffer(m_device.impl(), "probe ray data", rays * sizeof(RayDatum), kAddressed);
    m_hits = std::move(hits);
    m_fixedRays = std::move(fixedRays);
}

void VolumePasses::recordClear(const Recorder& recorder, LeakGuard guard) {
    // After whatever used the probes before: their content is dropped, but a layout change is a write too.
    recorder.orderAll();
    const auto used = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
    const auto all = vk::ImageSubresourceRange(vk::ImageAspectFlagBits::eColor, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS);
    std::vector<vk::ImageMemoryBarrier2> toGeneral;
    for (const Image* image : {&m_irradiance, &m_visibility})
        toGeneral.push_back({vk::PipelineStageFlagBits2::eAllCommands, used, vk::PipelineStageFlagBits2::eTransfer,
                             vk::AccessFlagBits2::eTransferWrite, vk::ImageLayout::eUndefined,
                             vk::ImageLayout::eGeneral, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                             image->handle(), all});
    recorder.commands().pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(toGeneral), recorder.dispatcher());
    const vk::ClearColorValue black(std::array<float, 4>{});
    for (const Image* image : {&m_irradiance, &m_visibility})
        recorder.commands().clearColorImage(image->handle(), vk::ImageLayout::eGeneral, black, all,
                                            recorder.dispatcher());
    recorder.fill(m_states, 0);
    recorder.fill(m_filters, 0);
    recorder.fill(m_sides, 0);
    m_recordedGuard = guard;
    recorder.write(m_constants, bytesOf(constants(guard)));
    recorder.orderAll();
}

void VolumePasses::recordGuard(const Recorder& recorder, const FieldDesc& desc) {
    if (desc.guard == m_recordedGuard) return;
    m_recordedGuard = desc.guard;
    recorder.orderAll();
    recorder.write(m_constants, bytesOf(constants(desc.guard)));
    recorder.orderAll();
}

void VolumePasses::recordWeights(const Recorder& recorder, const UpdateFrame& frame, Profiler* profiler) {
    const PassScope scope(recorder, m_device.impl(), profiler, "weights");
    recorder.push(kernels::WeightsPush{.directions = packAddress(m_directions.address()),
                                       .irradianceWeights = packAddress(m_irradianceWeights.address()),
                                       .visibilityRays = packAddress(m_visibilityRays.address()),
                                       .visibilityWeights = packAddress(m_visibilityWeights.address()),
                                       .rays = int(m_layout.rays),
                                       .irradianceTexels = int(m_layout.irradianceTexels),
                                       .visibilityTexels = int(m_layout.visibilityTexels),
                                       .irradianceSize = frame.desc.irradianceTexels,
                                       .visibilitySize = frame.desc.visibilityTexels,
                                       .visibilityExponent = frame.desc.visibilityExponent,
                                       .rules = int(frame.desc.rules)});
    recorder.dispatchOver("blend_weights", m_layout.irradianceTexels + m_layout.visibilityTexels);
}

void VolumePasses::recordTrace(const Recorder& recorder, const UpdateFrame& frame, const GpuScene& scene,
                               const GpuLighting& lighting, const RayAddresses& data, Profiler* profiler) {
    const std::uint64_t rays = std::uint64_t(m_layout.probes) * (m_layout.rays + frame.fixedDirections.size());
    recorder.bindScene(scene.impl().set());
    recorder.push(kernels::TracePush{.directions = packAddress(m_directions.address()),
                                     .hits = packAddress(m_hits.address()),
                                     .rayData = packAddress(m_rayData.address()),
                                     .lighting = packAddress(lighting.impl().address()),
                                     .fixedRays = packAddress(m_fixedRays.address()),
                                     .rays = int(m_layout.rays),
                                     .fixedRayCount = int(frame.fixedDirections.size()),
                                     .probes = int(m_layout.probes),
                                     .bounces = frame.bounces ? 1 : 0,
                                     .looks = data.looks,
                                     .emitterLights = packAddress(data.emitterLights),
                                     .emitterSeed = frame.raySeed});
    {
        const PassScope scope(recorder, m_device.impl(), profiler, "trace");
        recorder.dispatchOver(scene.impl().shader("trace_probes"), rays);
    }
    recorder.computeToCompute();
    {
        const PassScope scope(recorder, m_device.impl(), profiler, "shade");
        recorder.dispatchOver(scene.impl().shader("shade_probes"), rays);
    }
    if (data.looks > 0) {
        const PassScope scope(recorder, m_device.impl(), profiler, "emitters");
        recorder.dispatchOver(scene.impl().shader("look_at_emitters"), m_layout.probes * std::uint64_t(data.looks));
    }
    recorder.computeToCompute();
}

void VolumePasses::recordBlend(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                               Profiler* profiler) {
    recorder.push(kernels::BlendPush{.rayData = packAddress(data.update),
                                     .sides = packAddress(m_sides.address()),
                                     .irradianceWeights = packAddress(m_irradianceWeights.address()),
                                     .visibilityRays = packAddress(m_visibilityRays.address()),
                                     .visibilityWeights = packAddress(m_visibilityWeights.address()),
                                     .rays = int(m_layout.rays),
                                     .probes = int(m_layout.probes),
                                     .maxDistance = m_layout.maxDistance,
                                     .irradianceHysteresis = frame.hysteresis.irradiance,
                                     .visibilityHysteresis = frame.hysteresis.visibility,
                                     .significantChange = frame.desc.significantChange,
                                     .newDistribution = frame.desc.newDistribution,
                                     .ditherSeed = frame.ditherSeed,
                                     .linear = frame.linear ? 1 : 0,
                                     .emitterLights = packAddress(data.emitterLights),
                                     .looks = data.looks,
                                     .steps = frame.windows ? packAddress(m_steps.address()) : kernels::uvec2(0),
                                     .changes = packAddress(m_changes.address())});
    {
        const PassScope scope(recorder, m_device.impl(), profiler, "blend irradiance");
        recorder.dispatchOver("blend_irradiance", groups(m_layout.probes, kernels::kIrradianceGroupProbes),
                              groups(m_layout.irradianceTexels, kernels::kIrradianceGroupTexels),
                              irradianceConstants(frame.desc));
    }
    {
        const PassScope scope(recorder, m_device.impl(), profiler, "blend visibility");
        recorder.dispatchOver("blend_visibility", groups(m_layout.probes, kernels::kVisibilityGroupProbes), 1);
    }
}

void VolumePasses::recordWindows(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                                 Profiler* profiler) {
    if (!frame.windows) return;
    const PassScope scope(recorder, m_device.impl(), profiler, "windows");
    recorder.push(filterPush(frame, data));
    recorder.dispatchOver("probe_lag", m_layout.probes);
    recorder.computeToCompute();
    recorder.dispatchOver("probe_windows", m_layout.probes);
    recorder.computeToCompute();
}

void VolumePasses::recordFilter(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                                Profiler* profiler) {
    recorder.computeToCompute();
    const PassScope scope(recorder, m_device.impl(), profiler, "filter");
    recorder.push(filterPush(frame, data));
    recorder.dispatchOver("probe_filter", m_layout.probes);
}

kernels::FilterPush VolumePasses::filterPush(const UpdateFrame& frame, const RayAddresses& data) const {
    const bool own = frame.fixedDirections.empty();
    return {.steps = packAddress(m_steps.address()),
            .filters = packAddress(m_filters.address()),
            .changes = packAddress(m_changes.address()),
            .rayData = packAddress(own ? data.update : data.fixed),
            .directions = packAddress(m_directions.address() + m_layout.rays * sizeof(glm::vec3)),
            .rays = int(own ? m_layout.rays : frame.fixedDirections.size()),
            .probes = int(m_layout.probes),
            .ownRays = own ? 1 : 0,
            .texels = int(m_layout.irradianceTexels),
            .maxDistance = m_layout.maxDistance,
            .longestWindow = frame.windows ? frame.longestWindow : 1.0f / (1.0f - frame.hysteresis.irradiance),
            .longestVisibilityWindow = frame.longestVisibilityWindow,
            .ditherSeed = frame.ditherSeed,
            .forget = frame.windows ? 0 : 1};
}

void VolumePasses::recordSolidProbes(const Recorder& recorder, Profiler* profiler) {
    const PassScope scope(recorder, m_device.impl(), profiler, "solid probes");
    recorder.push(kernels::SolidPush{.sides = packAddress(m_sides.address()), .probes = int(m_layout.probes)});
    recorder.dispatchOver("find_solid_probes", m_layout.probes);
}

void VolumePasses::beginUpdate(const Recorder& recorder, const UpdateFrame& frame, Profiler* profiler) {
    // Whatever can fail comes first: an update is recorded whole or not at all.
    PipelineStore& pipelines = *m_device.impl().pipelines;
    for (const char* shader : {"blend_weights", "probe_lag", "probe_windows", "probe_filter"}) pipelines.get(shader);
    pipelines.get("blend_visibility");
    pipelines.get("find_solid_probes");
    pipelines.get("blend_irradiance", irradianceConstants(frame.desc));
    recordGuard(recorder, frame.desc);
    recorder.orderAll();
    recorder.write(m_directions, std::as_bytes(frame.directions));
    recorder.write(m_directions, std::as_bytes(frame.fixedDirections), frame.directions.size_bytes());
    recorder.transferToCompute();
    recorder.bindVolume(set());
    recordWeights(recorder, frame, profiler);
}

void VolumePasses::recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const GpuScene& scene,
                                const GpuLighting& lighting, Profiler* profiler) {
    const int looks = scene.impl().emitters.empty() ? 0 : emitterLooks(frame.desc);
    makeRayBuffers(looks);
    for (const char* shader : {"trace_probes", "shade_probes", "look_at_emitters"})
        m_device.impl().pipelines->get(scene.impl().shader(shader));
    const RayAddresses data{m_rayData.address(), m_fixedRays.address(), m_emitterLights.address(), looks};
    beginUpdate(recorder, frame, profiler);
    recordTrace(recorder, frame, scene, lighting, data, profiler);
    recordRest(recorder, frame, data, profiler);
}

void VolumePasses::recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                                Profiler* profiler) {
    beginUpdate(recorder, frame, profiler);
    recorder.computeToCompute();
    recordRest(recorder, frame, data, profiler);
}

void VolumePasses::recordRest(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                              Profiler* profiler) {
    recordWindows(recorder, frame, data, profiler);
    recordBlend(recorder, frame, data, profiler);
    recordFilter(recorder, frame, data, profiler);
    recordSolidProbes(recorder, profiler);
    recorder.orderAll();
}

void VolumePasses::recordQuery(const Recorder& recorder, const FieldDesc& desc, VkDeviceAddress queries,
                               VkDeviceAddress irradiance, std::uint32_t count, Profiler* profiler) {
    recordGuard(recorder, desc);
    const PassScope scope(recorder, m_device.impl(), profiler, "query");
    recorder.bindVolume(set());
    recorder.push(
        kernels::QueryPush{.queries = packAddress(queries), .irradiance = packAddress(irradiance), .count = count});
    recorder.dispatchOver("query", count);
}

}  // namespace probegi::vulkan
