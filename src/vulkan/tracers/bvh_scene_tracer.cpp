#include "bvh/binary_tree.h"
#include "bvh/wide_bvh.h"
#include "vulkan/device/errors.h"
#include "vulkan/tracers/scene_tracer.h"

namespace probegi::vulkan {

namespace {

TriangleSoup soupOf(const SurfaceMesh& mesh) {
    return {.positions = mesh.vertices.data(),
            .positionStride = sizeof(SurfaceVertex),
            .positionCount = mesh.vertices.size(),
            .triangles = mesh.triangles.data(),
            .triangleStride = sizeof(SurfaceTriangle),
            .triangleCount = mesh.triangles.size()};
}

/// The library's own BVH, built on the context's threads. The top level is at the start of the node array, so that a
/// refit overwrites it in place.
class BvhSceneTracer final : public SceneTracer {
public:
    explicit BvhSceneTracer(const TracedScene& scene) {
        const Context& context = scene.context;
        const SceneGeometry& geometry = scene.geometry;
        std::vector<TriangleBvh> groups;
        for (const SurfaceGroup& group : geometry.groups)
            groups.push_back(orThrow(buildTriangleBvh(context, soupOf(group.opaque), soupOf(group.masked))));
        for (const TriangleBvh& group : groups) m_groupBounds.push_back(group.bounds);
        m_top = orThrow(buildInstanceBvh(context, boxesOf(geometry.placements)));
        m_instancesRoot = m_arrays.append(m_top);
        m_worldRoot = m_arrays.append(
            orThrow(buildTriangleBvh(context, soupOf(geometry.world.opaque), soupOf(geometry.world.masked))));
        for (const TriangleBvh& group : groups) m_groupRoots.push_back(m_arrays.append(group));
        m_instances = instancesOf(geometry.placements);
        m_nodeBuffer = scene.staging.add(scene.device.impl(), "BVH nodes", m_arrays.nodes);
        m_triangleBuffer = scene.staging.add(scene.device.impl(), "BVH triangles", m_arrays.triangles);
        m_instanceBuffer = scene.staging.add(scene.device.impl(), "BVH instances", m_instances);
    }

    kernels::TracerBlock block() const noexcept override {
        return {{packAddress(m_nodeBuffer.address()), packAddress(m_triangleBuffer.address()),
                 packAddress(m_instanceBuffer.address())},
                {m_worldRoot, m_instancesRoot}};
    }
    void recordBuild(const Recorder&) override {}

    void recordPlacements(const Recorder& recorder, const std::vector<Placement>& placements) override {
        refit(m_top, boxesOf(placements));
        recorder.write(m_nodeBuffer, std::as_bytes(std::span(m_top.nodes)));
        const std::vector<kernels::BvhInstance> instances = instancesOf(placements);
        recorder.write(m_instanceBuffer, std::as_bytes(std::span(instances)));
    }

    void releaseStaging() noexcept override {
        m_arrays = {};
        m_instances = {};
    }
    std::size_t bytes() const noexcept override {
        return m_nodeBuffer.bytes() + m_triangleBuffer.bytes() + m_instanceBuffer.bytes();
    }

private:
    std::vector<Bounds> boxesOf(const std::vector<Placement>& placements) const {
        std::vector<Bounds> boxes;
        for (const Placement& p : placements) {
            const Bounds& bounds = m_groupBounds[std::size_t(p.group)];
            boxes.push_back(invertible(p.toWorld) ? placedBounds(bounds, p.toWorld) : kNothing);
        }
        return boxes;
    }
    // In the order of the top level's leaves.
    std::vector<kernels::BvhInstance> instancesOf(const std::vector<Placement>& placements) const {
        std::vector<kernels::BvhInstance> instances;
        for (const std::uint32_t number : m_top.order) {
            const Placement& p = placements[number];
            instances.push_back(makeBvhInstance(invertible(p.toWorld) ? p.toWorld : glm::mat4(1.0f),
                                                m_groupRoots[std::size_t(p.group)], int(number)));
        }
        return instances;
    }

    std::vector<Bounds> m_groupBounds;
    std::vector<std::uint32_t> m_groupRoots;
    InstanceBvh m_top;
    std::uint32_t m_worldRoot = 0, m_instancesRoot = 0;
    BvhArrays m_arrays;
    std::vector<kernels::BvhInstance> m_instances;
    Buffer m_nodeBuffer, m_triangleBuffer, m_instanceBuffer;
};

}  // namespace

std::unique_ptr<SceneTracer> makeBvhSceneTracer(const TracedScene& scene) {
    if (!treesFollowAHeuristic())
        scene.device.impl().warn(
            "this ProbeGI was built without Embree, so the BVH tracer uses median splits, which make rays slower; "
            "use ray query, or build with PROBEGI_EMBREE=ON");
    return std::make_unique<BvhSceneTracer>(scene);
}

}  // namespace probegi::vulkan
