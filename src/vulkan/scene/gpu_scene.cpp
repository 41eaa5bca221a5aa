#include <map>

#include "bvh/binary_tree.h"
#include "bvh/wide_bvh.h"
#include "geometry/lighting.h"
#include "sdf/sdf_emitters.h"
#include "vulkan/device/errors.h"
#include "vulkan/scene/gpu_scene_impl.h"

namespace probegi::vulkan {

namespace {

constexpr const char* kWrongKind =
    "TracerKind::sdf traces the primitives of GpuSceneDesc::sdf, and no other kind does; give both or neither";

}  // namespace

GpuScene::Impl::Impl(const Context& context, const Device& d, const Scene& scene, const ScenePose& pose,
                     const GpuSceneDesc& desc, const SceneTracerType& type)
    : device(d), tracerType(type) {
    if ((desc.sdf != nullptr) != (type.kind == TracerKind::sdf)) throw Failure(ErrorCode::invalidArgument, kWrongKind);
    orThrow(checkNodes(scene, desc.movableNodes, "movableNodes"));
    if (desc.sdf) primitives = orThrow(PlacedPrimitives::create(*desc.sdf, scene, pose));
    const Scene nothing;
    const Scene& shown = primitives ? nothing : scene;
    const ScenePose& shownPose = primitives ? poseAt(nothing) : pose;
    const SceneGeometry geometry = SceneGeometry::gather(
        shown, shownPose, primitives ? InstancePredicate() : movableInstances(scene, desc.movable, desc.movableNodes));
    measure(geometry);
    if (type.hitsTriangles) emitterGeometry = EmitterGeometry(scene, pose);
    emitters = primitives ? emittersOf(primitives->primitives(), primitives->solids()) : emitterGeometry.placed();
    data = packScene(geometry, emitters, shown, MipMaps(context, shown));
    if (primitives && !emitters.empty()) data.materials = packEmitterMaterials(emitters);
    upload();
    tracer =
        type.make({context, device, geometry, data, vertices.address(), staging, primitives ? &*primitives : nullptr});
    staging.fill(device.impl());
    constantsBuffer = Buffer(device.impl(), "scene constants", sizeof(kernels::SceneConstants),
                             vk::BufferUsageFlagBits::eUniformBuffer | vk::BufferUsageFlagBits::eTransferDst);
    writeSet();
}

void GpuScene::Impl::measure(const SceneGeometry& geometry) {
    placements = geometry.placements;
    bounds = primitives ? primitives->bounds() : geometry.bounds();
    worldBounds = geometry.world.bounds();
    hasWorld = !geometry.world.empty();
    for (const SurfaceGroup& group : geometry.groups) groupBounds.push_back(group.bounds());
}

void GpuScene::Impl::upload() {
    const Device::Impl& on = device.impl();
    vk::BufferUsageFlags vertexUsage = kAddressed;
    if (on.rayQuery) vertexUsage |= vk::BufferUsageFlagBits::eAccelerationStructureBuildInputReadOnlyKHR;
    vertices = staging.add(on, "vertices", data.vertices, vertexUsage);
    triangles = staging.add(on, "triangles", data.triangles);
    uv1 = staging.add(on, "second uvs", data.uv1);
    tangents = staging.add(on, "tangents", data.tangents);
    meshes = staging.add(on, "meshes", data.meshes);
    instances = staging.add(on, "instances", data.instances);
    materials = staging.add(on, "materials", data.materials);
    textures = staging.add(on, "textures", data.textures);
    texels = staging.add(on, "texels", data.texels);
    srgbTable = staging.add(on, "sRGB table", data.srgbTable);
    emitterBuffer = staging.add(on, "emitters", data.emitters);
}

void GpuScene::Impl::writeSet() {
    const Device::Impl& on = device.impl();
    const vk::DescriptorPoolSize size(vk::DescriptorType::eUniformBuffer, 1);
    pool = vk::raii::DescriptorPool(
        on.device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size));
    sets = vk::raii::DescriptorSets(on.device, vk::DescriptorSetAllocateInfo(*pool, *on.pipelines->layout().scene));
    const vk::DescriptorBufferInfo info(constantsBuffer.handle(), 0, VK_WHOLE_SIZE);
    on.device.updateDescriptorSets(
        vk::WriteDescriptorSet(set(), 0, 0, 1, vk::DescriptorType::eUniformBuffer, nullptr, &info), {});
}

Bounds GpuScene::Impl::placedBounds() const {
    Bounds all = hasWorld ? worldBounds : kNothing;
    for (const Placement& p : placements)
        all = united(all, probegi::placedBounds(groupBounds[std::size_t(p.group)], p.toWorld));
    return all;
}

kernels::SceneConstants GpuScene::Impl::constants() const {
    kernels::SceneConstants c{};
    c.scene.vertices = packAddress(vertices.address());
    c.scene.triangles = packAddress(triangles.address());
    c.scene.uv1 = packAddress(uv1.address());
    c.scene.tangents = packAddress(tangents.address());
    c.scene.meshes = packAddress(meshes.address());
    c.scene.instances = packAddress(instances.address());
    c.scene.materials = packAddress(materials.address());
    c.scene.textures = packAddress(textures.address());
    c.scene.texels = packAddress(texels.address());
    c.scene.srgbTable = packAddress(srgbTable.address());
    c.scene.magnitude = sceneMagnitude(bounds);
    c.scene.emitters = packAddress(emitterBuffer.address());
    c.scene.emitterCount = int(emitters.triangles.size());
    c.scene.inverseEmitterPower = emitters.inversePower;
    c.tracer = tracer->block();
    return c;
}

bool GpuScene::Impl::placeEmitters() {
    bool moved = false;
    for (const Placement& p : placements) moved = emitterGeometry.place(p.node, p.toWorld) || moved;
    if (moved) emitters = emitterGeometry.placed();
    return moved;
}

GpuScene::GpuScene(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
GpuScene::GpuScene(GpuScene&&) noexcept = default;
GpuScene& GpuScene::operator=(GpuScene&&) noexcept = default;
GpuScene::~GpuScene() = default;

Result<GpuScene> GpuScene::create(const Context& context, const Device& device, const Scene& scene,
                                  const ScenePose& pose, const GpuSceneDesc& desc) {
    return guarded("uploading the scene", [&] {
        return orThrow(Impl::create(context, device, scene, pose, desc, sceneTracerType(device, desc.tracer)));
    });
}

Result<GpuScene> GpuScene::Impl::create(const Context& context, const Device& device, const Scene& scene,
                                        const ScenePose& pose, const GpuSceneDesc& desc, const SceneTracerType& type) {
    return guarded("uploading the scene",
                   [&] { return GpuScene(std::make_unique<Impl>(context, device, scene, pose, desc, type)); });
}

Result<void> GpuScene::recordUpload(VkCommandBuffer commands) {
    if (m_impl->staging.released()) return fail(ErrorCode::invalidArgument, kNothingToUpload);
    return guarded("recording the upload of a scene", [&] {
        const Recorder recorder(m_impl->device.impl(), commands);
        m_impl->staging.record(recorder);
        recorder.write(m_impl->constantsBuffer, bytesOf(m_impl->constants()));
        m_impl->tracer->recordBuild(recorder);
        recorder.orderAll();
    });
}

void GpuScene::releaseStaging() noexcept {
    m_impl->staging.release();
    m_impl->tracer->releaseStaging();
    m_impl->data = {};
}

Result<void> GpuScene::recordPose(VkCommandBuffer commands, const ScenePose& pose) {
    if (m_impl->primitives) return m_impl->movePrimitives(commands, pose);
    auto placements = movedPlacements(m_impl->placements, pose);
    if (!placements) return placements.error();
    return guarded("moving instances", [&] {
        std::vector<kernels::GpuInstance> instances;
        for (const Placement& placement : *placements) instances.push_back(packInstance(placement));
        m_impl->placements = std::move(*placements);
        m_impl->bounds = m_impl->placedBounds();
        std::vector<kernels::GpuEmitter> lamps;
        if (m_impl->placeEmitters()) lamps = packEmitters(m_impl->emitters);
        const Recorder recorder(m_impl->device.impl(), commands);
        recorder.orderAll();
        recorder.write(m_impl->instances, std::as_bytes(std::span(instances)));
        recorder.write(m_impl->emitterBuffer, std::as_bytes(std::span(lamps)));
        m_impl->tracer->recordPlacements(recorder, m_impl->placements);
        recorder.write(m_impl->constantsBuffer, bytesOf(m_impl->constants()));
        recorder.orderAll();
    });
}

Result<void> GpuScene::Impl::movePrimitives(VkCommandBuffer commands, const ScenePose& pose) {
    if (auto moved = primitives->setPose(pose); !moved) return moved;
    return guarded("moving primitives", [&] {
        bounds = primitives->bounds();
        emitters = emittersOf(primitives->primitives(), primitives->solids());
        const std::vector<kernels::GpuEmitter> lamps = packEmitters(emitters);
        const Recorder recorder(device.impl(), commands);
        recorder.orderAll();
        recorder.write(emitterBuffer, std::as_bytes(std::span(lamps)));
        tracer->recordPrimitives(recorder, *primitives);
        recorder.write(constantsBuffer, bytesOf(constants()));
        recorder.orderAll();
    });
}

TracerKind GpuScene::tracer() const noexcept {
    return m_impl->tracerType.kind;
}
Bounds GpuScene::bounds() const noexcept {
    return m_impl->bounds;
}

std::size_t GpuScene::bytes() const noexcept {
    const Impl& m = *m_impl;
    std::size_t sum = m.constantsBuffer.bytes() + m.tracer->bytes();
    for (const Buffer* buffer : {&m.vertices, &m.triangles, &m.uv1, &m.tangents, &m.meshes, &m.instances, &m.materials,
                                 &m.textures, &m.texels, &m.srgbTable, &m.emitterBuffer})
        sum += buffer->bytes();
    return sum;
}

}  // namespace probegi::vulkan
