#include "vulkan/field/field_passes.h"

#include <limits>

#include "core/sentence.h"
#include "field/probe_emitters.h"
#include "field/volume_access.h"
#include "kernels/lookup/probe_query.h"
#include "kernels/probe/solid_probe.h"
#include "vulkan/device/errors.h"
#include "vulkan/field/pool_tiles.h"
#include "vulkan/scene/gpu_lighting_impl.h"
#include "vulkan/scene/gpu_scene_impl.h"

namespace probegi::vulkan {

namespace {

// Specialisation constants of blend_irradiance.comp.
std::array<std::uint32_t, 1> irradianceConstants(const FieldSettings& settings) {
    return {settings.backfaceRule == BackfaceRule::excluded ? 1u : 0u};
}

// One shape for both atlases: a probe has the same tile in each.
PoolShape poolShape(const Device& device, const FieldDesc& desc) {
    const auto& limits = device.impl().limits;
    const std::uint32_t tile = std::uint32_t(std::max(desc.irradianceTexels, desc.visibilityTexels) + 2);
    const std::size_t slots = std::size_t(probeCount(desc));
    const PoolShape shape = shapeOfPool(slots, tile, limits.maxImageDimension2D, limits.maxImageArrayLayers);
    if (shape.layers == 0)
        throw Failure(
            ErrorCode::unsupported,
            sentence(slots, " probes do not fit into this device's images; with maps of ", tile - 2,
                     " texels it holds ", mostSlots(tile, limits.maxImageDimension2D, limits.maxImageArrayLayers)));
    return shape;
}

Image makeAtlas(const Device& device, const char* name, vk::Format format, const PoolShape& shape, int texels) {
    const std::uint32_t tile = std::uint32_t(texels + 2);
    return {device.impl(), name, format, {tile << shape.tiles.rowShift, tile * shape.rows}, shape.layers};
}

// Shaders count rays, and index the buffers of rays, in 31 bits.
FieldLayout checkedLayout(const FieldDesc& desc) {
    const FieldLayout layout(desc);
    constexpr std::size_t kMost = std::size_t(std::numeric_limits<std::int32_t>::max());
    const std::size_t rays = layout.rays + std::size_t(desc.fixedRays);
    if (layout.probes * rays > kMost)
        throw Failure(ErrorCode::unsupported, sentence(layout.probes, " probes with ", rays,
                                                       " rays each are more rays than the GPU backend counts, ", kMost,
                                                       "; use fewer probes or raysPerProbe"));
    return layout;
}

}  // namespace

FieldPasses::FieldPasses(const Device& device, const FieldDesc& desc)
    : m_device(device),
      m_desc(desc),
      m_layout(checkedLayout(desc)),
      m_volumes(makeVolumes(desc)),
      m_byDensity(volumesByDensity(desc)),
      m_constants(device.impl(), "field constants", sizeof(kernels::FieldConstants),
                  vk::BufferUsageFlagBits::eUniformBuffer | vk::BufferUsageFlagBits::eStorageBuffer |
                      vk::BufferUsageFlagBits::eTransferDst),
      m_states(device.impl(), "probe states", sizeof(std::uint32_t) + m_layout.probes * sizeof(kernels::ProbeStatus),
               vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst |
                   vk::BufferUsageFlagBits::eTransferSrc),
      m_tasks(device.impl(), "tasks", sizeof(kernels::GpuTaskCounts) + m_layout.probes * sizeof(ProbeTask),
              kAddressed | vk::BufferUsageFlagBits::eIndirectBuffer | vk::BufferUsageFlagBits::eTransferSrc),
      m_sides(device.impl(), "probe sides", m_layout.probes * sizeof(kernels::ProbeSides),
              kAddressed | vk::BufferUsageFlagBits::eTransferSrc),
      m_filters(device.impl(), "temporal filters", m_layout.probes * sizeof(kernels::PackedProbeFilter),
                kAddressed | vk::BufferUsageFlagBits::eTransferSrc),
      m_steps(device.impl(), "temporal steps", m_layout.probes * sizeof(kernels::GpuProbeStep), kAddressed),
      m_changes(device.impl(), "texel changes",
                m_layout.probes *
                    kernels::groupsOf(std::uint32_t(m_layout.irradianceTexels), kernels::kIrradianceGroupTexels) *
                    sizeof(kernels::TexelChange),
                kAddressed),
      m_directions(device.impl(), "ray directions", (m_layout.rays + std::size_t(desc.fixedRays)) * sizeof(glm::vec3),
                   kAddressed),
      m_events(device.impl(), "events", kernels::kMostEventRegions * sizeof(kernels::EventRegion), kAddressed),
      m_irradianceWeights(device.impl(), "irradiance weights",
                          m_layout.rays * m_layout.irradianceTexels * sizeof(float), kAddressed),
      m_visibilityRays(device.impl(), "rays of visibility texels",
                       m_layout.visibilityTexels * sizeof(kernels::GpuTexelRays), kAddressed),
      m_visibilityWeights(device.impl(), "visibility weights",
                          m_layout.rays * m_layout.visibilityTexels * sizeof(kernels::GpuRayWeight), kAddressed) {
    if (watched()) {
        m_surfaces = Buffer(device.impl(), "probes at surfaces", m_layout.probes * sizeof(std::uint32_t), kAddressed);
        m_bounds = Buffer(device.impl(), "bounds of what moves", kMostBounds * sizeof(kernels::GpuBounds), kAddressed);
        m_chosen = Buffer(device.impl(), "chosen probes", m_layout.probes * sizeof(std::uint32_t), kAddressed);
    }
    const PoolShape shape = poolShape(device, desc);
    m_tiles = shape.tiles;
    m_irradiance = makeAtlas(device, "irradiance", kIrradianceFormat, shape, desc.irradianceTexels);
    m_visibility = makeAtlas(device, "visibility", kVisibilityFormat, shape, desc.visibilityTexels);
    writeSet();
}

void FieldPasses::writeSet() {
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

void FieldPasses::writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding,
                                     QueryConstants constantsKind) const {
    const Device::Impl& device = m_device.impl();
    const vk::Sampler sampler = *device.pipelines->layout().sampler;
    const vk::DescriptorBufferInfo constants(m_constants.handle(), 0, VK_WHOLE_SIZE);
    const vk::DescriptorBufferInfo states(m_states.handle(), 0, VK_WHOLE_SIZE);
    const vk::DescriptorImageInfo images[] = {{sampler, m_irradiance.view(), vk::ImageLayout::eGeneral},
                                              {sampler, m_visibility.view(), vk::ImageLayout::eGeneral}};
    using Type = vk::DescriptorType;
    const vk::WriteDescriptorSet writes[] = {
        {set, firstBinding, 0, 1, constantsType(constantsKind), nullptr, &constants},
        {set, firstBinding + 1, 0, 1, Type::eCombinedImageSampler, &images[0]},
        {set, firstBinding + 2, 0, 1, Type::eCombinedImageSampler, &images[1]},
        {set, firstBinding + 3, 0, 1, Type::eStorageBuffer, nullptr, &states}};
    device.device.updateDescriptorSets(writes, {});
}

FieldMemory FieldPasses::memory() const noexcept {
    std::size_t earlier = 0;
    for (const Buffer& buffer : m_earlier) earlier += buffer.bytes();
    return {m_irradiance.bytes(), m_visibility.bytes(),
            m_states.bytes() + m_tasks.bytes() + m_sides.bytes() + m_filters.bytes() + m_constants.bytes() +
                m_directions.bytes() + m_surfaces.bytes() + m_bounds.bytes() + m_chosen.bytes() + m_events.bytes() +
                m_limits.bytes() + m_progress.bytes() + m_masks.bytes() + m_blockers.bytes() + earlier,
            m_irradianceWeights.bytes() + m_visibilityRays.bytes() + m_visibilityWeights.bytes() + m_hits.bytes() +
                m_rayData.bytes() + m_fixedRays.bytes() + m_emitterLights.bytes() + m_steps.bytes() +
                m_changes.bytes()};
}

void FieldPasses::makeRayBuffers(int looks) {
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

void FieldPasses::makeBudgetBuffers(const UpdateFrame& frame) {
    if (!frame.limits.empty() && !m_limits)
        m_limits =
            Buffer(m_device.impl(), "limits of events", m_layout.probes * sizeof(kernels::EventLimit), kAddressed);
    if (!frame.reportsProgress || m_progress) return;
    m_progress = Buffer(m_device.impl(), "progress of probes", m_layout.probes * sizeof(kernels::ProbeProgress),
                        kAddressed, MemoryUse::readback);
    const auto progress = m_progress.mapped<kernels::ProbeProgress>();
    std::fill(progress.begin(), progress.end(), kernels::ProbeProgress{0, -1, 0, 0});  // not known
}

void FieldPasses::recordClear(const Recorder& recorder, const FieldSettings& settings, const kernels::RaySet& rays) {
    // Wait for all earlier uses of the probes: their contents are discarded, but a layout change is a write too.
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
    if (watched()) recorder.fill(m_surfaces, 0);
    m_hasNew = true;
    m_listed = false;
    m_recordedSettings = settings;
    m_recordedTasks.reset();
    m_rays = rays;
    recordConstants(recorder, settings);
    recorder.orderAll();
}

void FieldPasses::recordEnter(const Recorder& recorder, const FieldSettings& settings, int volume, glm::ivec3 cells) {
    recordSettings(recorder, settings);
    recorder.orderAll();
    recorder.bindVolume(set());
    recorder.push(kernels::EnterPush{.sides = packAddress(m_sides.address()),
                                     .filters = packAddress(m_filters.address()),
                                     .surfaces = watched() ? packAddress(m_surfaces.address()) : kernels::uvec2(0),
                                     .volume = volume,
                                     .cells = cells});
    recorder.dispatchOver("enter_volume", std::size_t(kernels::volumeProbes(m_volumes[std::size_t(volume)])));
    recorder.orderAll();
    m_hasNew = true;
}

kernels::PlacesPush FieldPasses::placesPush(const UpdateFrame& frame, const PlacesFrame& places) const {
    const bool all = places.chosen.empty();
    return {.surfaces = packAddress(m_surfaces.address()),
            .boxes = packAddress(m_bounds.address()),
            .sides = packAddress(m_sides.address()),
            .filters = packAddress(m_filters.address()),
            .tasks = packAddress(m_tasks.address()),
            .chosen = all ? kernels::uvec2(0) : packAddress(m_chosen.address()),
            .rayData = kernels::uvec2(0),
            .directions = packAddress(m_directions.address()),
            .slots = std::uint32_t(m_layout.probes),
            .listed = std::uint32_t(all ? m_layout.probes : places.chosen.size()),
            .moving = std::uint32_t(places.moving.size()),
            .media = std::uint32_t(places.media.size()),
            .rays = int(frame.directions.size()),
            .flags = (frame.desc.relocation ? kernels::kPlacesRelocate : 0) |
                     (frame.desc.probeStates ? kernels::kPlacesSleep : 0),
            .progress = frame.reportsProgress ? packAddress(m_progress.address()) : kernels::uvec2(0)};
}

void FieldPasses::recordPlaces(const Recorder& recorder, const UpdateFrame& frame, const PlacesFrame& places,
                               const GpuScene* scene, Profiler* profiler) {
    PipelineStore& pipelines = *m_device.impl().pipelines;
    for (const char* shader : {"step_states", "list_tasks", "count_tasks"}) pipelines.get(shader);
    if (scene)
        pipelines.get(scene->impl().shader("place_probes"));
    else
        pipelines.get("look_around");
    makeBudgetBuffers(frame);
    recordSettings(recorder, frame.settings);
    recorder.orderAll();
    std::vector<kernels::GpuBounds> bounds;
    for (const auto& list : {places.moving, places.media})
        for (const Bounds& b : list) bounds.push_back({b.lower, b.upper});
    recorder.write(m_bounds, std::as_bytes(std::span(bounds)));
    if (!places.chosen.empty() && m_recordedChoice != places.chosenList)
        recorder.write(m_chosen, std::as_bytes(places.chosen));
    m_recordedChoice = places.chosenList;
    recorder.write(m_tasks, bytesOf(std::uint32_t(0)));
    recorder.transferToCompute();
    const PassScope scope(recorder, m_device.impl(), profiler, "states");
    recorder.bindVolume(set());
    if (scene) recorder.bindScene(scene->impl().set());
    m_places = placesPush(frame, places);
    recorder.push(m_places);
    if (scene && m_hasNew) {
        recorder.dispatchOver(scene->impl().shader("place_probes"), std::uint32_t(m_layout.probes), 1);
        recorder.computeToCompute();
        m_hasNew = false;
    }
    recorder.dispatchOver("step_states", m_layout.probes);
    recorder.computeToCompute();
    recorder.dispatchOver("list_tasks", m_places.listed);
    recorder.computeToCompute();
    m_listed = true;
}

void FieldPasses::recordCounts(const Recorder& recorder, const UpdateFrame& frame) {
    recorder.push(kernels::TasksPush{.tasks = packAddress(m_tasks.address()),
                                     .count = 0,
                                     .rays = std::uint32_t(frame.directions.size() + frame.fixedDirections.size()),
                                     .looks = 0,
                                     .irradianceTexels = std::uint32_t(m_layout.irradianceTexels)});
    recorder.dispatch("count_tasks", 1);
    recorder.orderAll();
}

void FieldPasses::recordLook(const Recorder& recorder, const RayAddresses& data) {
    kernels::PlacesPush push = m_places;  // the bounds and tasks that were listed, whatever came since
    push.rayData = packAddress(data.update);
    if (data.format == RayFormat::packed) push.flags |= kernels::kPlacesPackedRays;
    recorder.push(push);
    recorder.dispatchIndirect("look_around", m_tasks, offsetof(kernels::GpuTaskCounts, perTask));
    recorder.orderAll();
}

void FieldPasses::recordPlacements(const Recorder& recorder, const FieldSettings& settings,
                                   VkDeviceAddress placements) {
    recordSettings(recorder, settings);
    recorder.orderAll();
    recorder.bindVolume(set());
    recorder.push(kernels::PlacementsPush{.placements = packAddress(placements),
                                          .sides = packAddress(m_sides.address()),
                                          .filters = packAddress(m_filters.address()),
                                          .count = std::uint32_t(m_layout.probes)});
    recorder.dispatchOver("set_placements", m_layout.probes);
    recorder.orderAll();
    m_recordedTasks.reset();  // origins are elsewhere
}

// Writes the task list if it has changed, then the sizes of the dispatches over it.
void FieldPasses::recordTasks(const Recorder& recorder, const UpdateFrame& frame, int looks) {
    const std::size_t rays = frame.directions.size() + frame.fixedDirections.size();
    recorder.push(kernels::TasksPush{.tasks = packAddress(m_tasks.address()),
                                     .count = std::uint32_t(frame.tasks.size()),
                                     .rays = std::uint32_t(rays),
                                     .looks = std::uint32_t(looks),
                                     .irradianceTexels = std::uint32_t(m_layout.irradianceTexels)});
    if (m_listed) {
        m_listed = false;
        m_recordedTasks.reset();
    } else if (m_recordedTasks != frame.taskList) {
        m_recordedTasks = frame.taskList;
        if (frame.whole()) {
            recorder.dispatchOver("all_tasks", frame.tasks.size());
            recorder.computeToCompute();
        } else {
            const auto count = std::uint32_t(frame.tasks.size());
            recorder.write(m_tasks, bytesOf(count));
            recorder.write(m_tasks, std::as_bytes(frame.tasks), sizeof(kernels::GpuTaskCounts));
            recorder.transferToCompute();
        }
    }
    recorder.dispatch("count_tasks", 1);
    if (frame.windows && (watched() || !frame.whole()))
        recorder.fill(m_steps, 0);  // probes that are not updated report no lag
    recorder.transferToCompute();
    recorder.computeToDispatch();
}

void FieldPasses::recordWeights(const Recorder& recorder, const UpdateFrame& frame, Profiler* profiler) {
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
                                       .visibilityExponent = frame.settings.visibilityExponent,
                                       .rules = int(frame.desc.rules)});
    recorder.dispatchOver("blend_weights", m_layout.irradianceTexels + m_layout.visibilityTexels);
}

void FieldPasses::recordTrace(const Recorder& recorder, const UpdateFrame& frame, const GpuScene& scene,
                              const GpuLighting& lighting, const RayAddresses& data, Profiler* profiler) {
    recorder.bindScene(scene.impl().set());
    recorder.push(kernels::TracePush{.tasks = packAddress(m_tasks.address()),
                                     .directions = packAddress(m_directions.address()),
                                     .hits = packAddress(m_hits.address()),
                                     .rayData = packAddress(m_rayData.address()),
                                     .lighting = packAddress(lighting.impl().address()),
                                     .fixedRays = packAddress(m_fixedRays.address()),
                                     .rays = int(m_layout.rays),
                                     .fixedRayCount = int(frame.fixedDirections.size()),
                                     .bounces = frame.bounces ? 1 : 0,
                                     .looks = data.looks,
                                     .emitterLights = packAddress(data.emitterLights),
                                     .emitterSeed = frame.raySeed});
    {
        const PassScope scope(recorder, m_device.impl(), profiler, "trace");
        recorder.dispatchIndirect(scene.impl().shader("trace_probes"), m_tasks,
                                  offsetof(kernels::GpuTaskCounts, perRay));
    }
    recorder.computeToCompute();
    {
        const PassScope scope(recorder, m_device.impl(), profiler, "shade");
        recorder.dispatchIndirect(scene.impl().shader("shade_probes"), m_tasks,
                                  offsetof(kernels::GpuTaskCounts, perRay));
    }
    if (data.looks > 0) {
        const PassScope scope(recorder, m_device.impl(), profiler, "emitters");
        recorder.dispatchIndirect(scene.impl().shader("look_at_emitters"), m_tasks,
                                  offsetof(kernels::GpuTaskCounts, perLook));
    }
    recorder.computeToCompute();
}

void FieldPasses::recordBlend(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                              Profiler* profiler) {
    recorder.push(kernels::BlendPush{
        .tasks = packAddress(m_tasks.address()),
        .rayData = packAddress(data.update),
        .sides = packAddress(m_sides.address()),
        .irradianceWeights = packAddress(m_irradianceWeights.address()),
        .visibilityRays = packAddress(m_visibilityRays.address()),
        .visibilityWeights = packAddress(m_visibilityWeights.address()),
        .rays = int(m_layout.rays),
        .irradianceHysteresis = frame.hysteresis.irradiance,
        .visibilityHysteresis = frame.hysteresis.visibility,
        .significantChange = frame.settings.significantChange,
        .newDistribution = frame.settings.newDistribution,
        .ditherSeed = frame.ditherSeed,
        .linear = frame.linear ? 1 : 0,
        .emitterLights = packAddress(data.emitterLights),
        .looks = data.looks,
        .steps = frame.windows || frame.hasEvents() ? packAddress(m_steps.address()) : kernels::uvec2(0),
        .changes = packAddress(m_changes.address()),
        .filters = packAddress(m_filters.address()),
        .packedRays = data.format == RayFormat::packed ? 1 : 0});
    {
        const PassScope scope(recorder, m_device.impl(), profiler, "blend irradiance");
        recorder.dispatchIndirect("blend_irradiance", m_tasks, offsetof(kernels::GpuTaskCounts, irradiance),
                                  irradianceConstants(frame.settings));
    }
    {
        const PassScope scope(recorder, m_device.impl(), profiler, "blend visibility");
        recorder.dispatchIndirect("blend_visibility", m_tasks, offsetof(kernels::GpuTaskCounts, visibility));
    }
}

void FieldPasses::recordWindows(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                                Profiler* profiler) {
    if (!frame.windows) return;
    const PassScope scope(recorder, m_device.impl(), profiler, "windows");
    recorder.push(filterPush(frame, data));
    recorder.dispatchIndirect("probe_lag", m_tasks, offsetof(kernels::GpuTaskCounts, perTask));
    recorder.computeToCompute();
    recorder.dispatchIndirect("probe_windows", m_tasks, offsetof(kernels::GpuTaskCounts, perTask));
    recorder.computeToCompute();
}

void FieldPasses::recordEvents(const Recorder& recorder, const UpdateFrame& frame, Profiler* profiler) {
    if (!frame.hasEvents()) return;
    const PassScope scope(recorder, m_device.impl(), profiler, "events");
    recorder.push(
        kernels::EventPush{.tasks = packAddress(m_tasks.address()),
                           .steps = packAddress(m_steps.address()),
                           .filters = packAddress(m_filters.address()),
                           .regions = packAddress(m_events.address()),
                           .count = frame.events.count,
                           .windows = frame.windows ? 1 : 0,
                           .irradianceHysteresis = frame.hysteresis.irradiance,
                           .visibilityHysteresis = frame.hysteresis.visibility,
                           .limits = frame.limits.empty() ? kernels::uvec2(0) : packAddress(m_limits.address())});
    recorder.dispatchIndirect("probe_events", m_tasks, offsetof(kernels::GpuTaskCounts, perTask));
    recorder.computeToCompute();
}

void FieldPasses::recordFilter(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                               Profiler* profiler) {
    recorder.computeToCompute();
    const PassScope scope(recorder, m_device.impl(), profiler, "filter");
    recorder.push(filterPush(frame, data));
    recorder.dispatchIndirect("probe_filter", m_tasks, offsetof(kernels::GpuTaskCounts, perTask));
    if (frame.reportsProgress) recorder.computeToHost();
}

kernels::FilterPush FieldPasses::filterPush(const UpdateFrame& frame, const RayAddresses& data) const {
    const bool own = frame.fixedDirections.empty();
    return {.tasks = packAddress(m_tasks.address()),
            .steps = packAddress(m_steps.address()),
            .filters = packAddress(m_filters.address()),
            .changes = packAddress(m_changes.address()),
            .rayData = packAddress(own ? data.update : data.fixed),
            .directions = packAddress(m_directions.address() + m_layout.rays * sizeof(glm::vec3)),
            .rays = int(own ? m_layout.rays : frame.fixedDirections.size()),
            .ownRays = !own                               ? 0
                       : data.format == RayFormat::packed ? kernels::kOwnRaysPacked
                                                          : 1,
            .texels = int(m_layout.irradianceTexels),
            .longestWindow = frame.windows ? frame.longestWindow : 1.0f / (1.0f - frame.hysteresis.irradiance),
            .longestVisibilityWindow = frame.longestVisibilityWindow,
            .ditherSeed = frame.ditherSeed,
            .forget = frame.windows ? 0 : 1,
            .settles = frame.settles ? 1 : 0,
            .progress = frame.reportsProgress ? packAddress(m_progress.address()) : kernels::uvec2(0)};
}

void FieldPasses::recordSolidProbes(const Recorder& recorder, Profiler* profiler) {
    const PassScope scope(recorder, m_device.impl(), profiler, "solid probes");
    recorder.push(kernels::SolidPush{.tasks = packAddress(m_tasks.address()), .sides = packAddress(m_sides.address())});
    recorder.dispatchIndirect("find_solid_probes", m_tasks, offsetof(kernels::GpuTaskCounts, perTask));
}

void FieldPasses::beginUpdate(const Recorder& recorder, const UpdateFrame& frame, int looks, Profiler* profiler) {
    // Everything that can fail comes first: an update is recorded completely or not at all.
    PipelineStore& pipelines = *m_device.impl().pipelines;
    for (const char* shader : {"all_tasks", "count_tasks", "blend_weights", "probe_lag", "probe_windows",
                               "probe_filter", "blend_visibility", "find_solid_probes"})
        pipelines.get(shader);
    if (frame.hasEvents()) pipelines.get("probe_events");
    makeBudgetBuffers(frame);
    pipelines.get("blend_irradiance", irradianceConstants(frame.settings));
    recordSettings(recorder, frame.settings);
    recorder.orderAll();
    recorder.write(m_directions, std::as_bytes(frame.directions));
    recorder.write(m_directions, std::as_bytes(frame.fixedDirections), frame.directions.size_bytes());
    if (!frame.events.empty()) recorder.write(m_events, std::as_bytes(frame.events.all()));
    if (!frame.limits.empty()) recorder.write(m_limits, std::as_bytes(frame.limits));
    // No pass of this update asks for them: shaders of the caller do, after it.
    m_rays = frame.nextRays;
    recorder.write(m_constants, bytesOf(m_rays), offsetof(kernels::FieldConstants, rays));
    recorder.transferToCompute();
    recorder.bindVolume(set());
    recordTasks(recorder, frame, looks);
    recordWeights(recorder, frame, profiler);
}

void FieldPasses::recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const GpuScene& scene,
                               const GpuLighting& lighting, Profiler* profiler) {
    const int looks = scene.impl().emitters.empty() ? 0 : emitterLooks(frame.desc);
    makeRayBuffers(looks);
    for (const char* shader : {"trace_probes", "shade_probes", "look_at_emitters"})
        m_device.impl().pipelines->get(scene.impl().shader(shader));
    const RayAddresses data{m_rayData.address(), m_fixedRays.address(), m_emitterLights.address(), looks};
    beginUpdate(recorder, frame, looks, profiler);
    recordTrace(recorder, frame, scene, lighting, data, profiler);
    recordRest(recorder, frame, data, profiler);
}

void FieldPasses::recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                               Profiler* profiler) {
    beginUpdate(recorder, frame, data.looks, profiler);
    recorder.computeToCompute();
    recordRest(recorder, frame, data, profiler);
}

void FieldPasses::recordRest(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                             Profiler* profiler) {
    recordWindows(recorder, frame, data, profiler);
    recordEvents(recorder, frame, profiler);
    recordBlend(recorder, frame, data, profiler);
    recordFilter(recorder, frame, data, profiler);
    recordSolidProbes(recorder, profiler);
    recorder.orderAll();
}

void FieldPasses::recordQuery(const Recorder& recorder, const FieldSettings& settings, VkDeviceAddress queries,
                              VkDeviceAddress irradiance, std::uint32_t count, Profiler* profiler) {
    recordSettings(recorder, settings);
    const PassScope scope(recorder, m_device.impl(), profiler, "query");
    recorder.bindVolume(set());
    recorder.push(
        kernels::QueryPush{.queries = packAddress(queries), .irradiance = packAddress(irradiance), .count = count});
    recorder.dispatchOver("query", count);
}

}  // namespace probegi::vulkan
