#include "vulkan/tracers/acceleration_structure.h"
#include "vulkan/tracers/scene_tracer.h"

namespace probegi::vulkan {

namespace {

constexpr auto kTriangleFlags = vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace;
constexpr auto kInstanceFlags = vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace |
                                vk::BuildAccelerationStructureFlagBitsKHR::eAllowUpdate;
constexpr vk::BufferUsageFlags kBuildInput = vk::BufferUsageFlagBits::eAccelerationStructureBuildInputReadOnlyKHR |
                                             vk::BufferUsageFlagBits::eShaderDeviceAddress |
                                             vk::BufferUsageFlagBits::eTransferDst;

VkTransformMatrixKHR rowsOf(const glm::mat4& m) {
    VkTransformMatrixKHR rows;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) rows.matrix[row][column] = m[column][row];
    return rows;
}

/// VK_KHR_acceleration_structure over the scene's vertices. There is a bottom level for the world and one for each
/// group, in the order of SceneData::meshes, with the opaque and the masked mesh as geometries 0 and 1, and a top level
/// of the world and the placements. Custom index: 0 for the world, placement + 1 otherwise.
class RayQuerySceneTracer final : public SceneTracer {
public:
    explicit RayQuerySceneTracer(const TracedScene& scene) : m_device(scene.device) {
        packIndices(scene.data);
        for (std::size_t group = 0; group <= scene.geometry.groups.size(); ++group)
            m_groups.push_back(makeGroup(scene.data, group, scene.vertices));
        m_instances = instancesOf(scene.geometry.placements);
        m_instanceBuffer = Buffer(m_device.impl(), "placements to trace",
                                  m_instances.size() * sizeof(VkAccelerationStructureInstanceKHR), kBuildInput);
        makeTop();
        m_staging.fill(m_device.impl());
    }

    kernels::TracerBlock block() const noexcept override { return {{packAddress(m_top.address())}, {}}; }

    void recordBuild(const Recorder& recorder) override {
        m_staging.record(recorder);
        recorder.write(m_instanceBuffer, std::as_bytes(std::span(m_instances)));
        recorder.orderAll();
        for (const AccelerationStructure& group : m_groups) group.recordBuild(recorder);
        recorder.orderAll();
        m_top.recordBuild(recorder);
        recorder.orderAll();
    }

    void recordPlacements(const Recorder& recorder, const std::vector<Placement>& placements) override {
        m_instances = instancesOf(placements);
        recorder.write(m_instanceBuffer, std::as_bytes(std::span(m_instances)));
        recorder.orderAll();
        m_top.recordBuild(recorder, true);
        recorder.orderAll();
    }

    void releaseStaging() noexcept override {
        m_staging.release();
        m_indexBuffer = Buffer();
        m_indices = {};
        for (AccelerationStructure& group : m_groups) group.releaseScratch();
    }

    std::size_t bytes() const noexcept override {
        std::size_t sum = m_top.bytes() + m_instanceBuffer.bytes() + m_indexBuffer.bytes();
        for (const AccelerationStructure& group : m_groups) sum += group.bytes();
        return sum;
    }

private:
    // Builds require tightly packed indices, three per triangle.
    void packIndices(const SceneData& data) {
        m_indices.reserve(3 * data.triangles.size());
        for (const kernels::GpuTriangle& t : data.triangles)
            m_indices.insert(m_indices.end(), {t.vertex.x, t.vertex.y, t.vertex.z});
        m_indexBuffer = m_staging.add(m_device.impl(), "indices to trace", m_indices, kBuildInput);
    }

    AccelerationStructure makeGroup(const SceneData& data, std::size_t group, VkDeviceAddress vertices) const {
        AccelerationStructure::Geometries geometries;
        AccelerationStructure::Ranges ranges;
        for (std::size_t geometry = 0; geometry < 2; ++geometry) {
            const std::size_t index = 2 * group + geometry;
            const kernels::GpuMesh& mesh = data.meshes[index];
            const std::size_t end =
                index + 1 < data.meshes.size() ? data.meshes[index + 1].firstVertex : data.vertices.size();
            const auto highest = std::uint32_t(std::max<std::size_t>(end, mesh.firstVertex + 1) - mesh.firstVertex - 1);
            // A mesh without triangles may start at the end of the buffers: its addresses would be outside them.
            const std::uint64_t vertex = mesh.triangleCount ? mesh.firstVertex : 0;
            const std::uint64_t triangle = mesh.triangleCount ? mesh.firstTriangle : 0;
            const vk::AccelerationStructureGeometryTrianglesDataKHR triangles(
                vk::Format::eR32G32B32Sfloat, vertices + vertex * sizeof(kernels::GpuVertex),
                sizeof(kernels::GpuVertex), highest, vk::IndexType::eUint32, m_indexBuffer.address() + 12 * triangle);
            geometries.push_back({vk::GeometryTypeKHR::eTriangles, triangles,
                                  geometry == 0 ? vk::GeometryFlagBitsKHR::eOpaque : vk::GeometryFlagsKHR()});
            ranges.emplace_back(mesh.triangleCount);
        }
        return {m_device.impl(), "triangles to trace",  vk::AccelerationStructureTypeKHR::eBottomLevel,
                kTriangleFlags,  std::move(geometries), std::move(ranges)};
    }

    void makeTop() {
        const vk::AccelerationStructureGeometryInstancesDataKHR instances(false, m_instanceBuffer.address());
        m_top = AccelerationStructure(
            m_device.impl(), "scene to trace", vk::AccelerationStructureTypeKHR::eTopLevel, kInstanceFlags,
            {vk::AccelerationStructureGeometryKHR(vk::GeometryTypeKHR::eInstances, instances)},
            {vk::AccelerationStructureBuildRangeInfoKHR(std::uint32_t(m_instances.size()))});
    }

    std::vector<VkAccelerationStructureInstanceKHR> instancesOf(const std::vector<Placement>& placements) const {
        const auto instance = [&](const glm::mat4& toWorld, std::size_t number, std::size_t group) {
            VkAccelerationStructureInstanceKHR result{};
            const bool solid = invertible(toWorld);
            result.transform = rowsOf(solid ? toWorld : glm::mat4(1.0f));
            result.instanceCustomIndex = std::uint32_t(number) & 0xffffffu;
            result.mask = solid ? 0xffu : 0u;
            result.accelerationStructureReference = m_groups[group].address();
            return result;
        };
        std::vector<VkAccelerationStructureInstanceKHR> result{instance(glm::mat4(1.0f), 0, 0)};
        for (const Placement& p : placements)
            result.push_back(instance(p.toWorld, result.size(), std::size_t(p.group) + 1));
        return result;
    }

    Device m_device;
    Staging m_staging;
    std::vector<std::uint32_t> m_indices;
    std::vector<VkAccelerationStructureInstanceKHR> m_instances;
    Buffer m_indexBuffer, m_instanceBuffer;
    std::vector<AccelerationStructure> m_groups;
    AccelerationStructure m_top;
};

}  // namespace

std::unique_ptr<SceneTracer> makeRayQuerySceneTracer(const TracedScene& scene) {
    return std::make_unique<RayQuerySceneTracer>(scene);
}

}  // namespace probegi::vulkan
