#include "vulkan/tracers/sdf_scene_tracer.h"

#include "sdf/clusters.h"
#include "sdf/paints.h"

namespace probegi::vulkan {

namespace {

/// What the GLSL half reads: the primitives cluster by cluster, or as they were given where there are no clusters.
struct SdfBuffers {
    std::vector<kernels::SdfSolid> solids;  ///< 48 bytes each, which every ray reads
    std::vector<kernels::SdfCluster> clusters;
    std::vector<std::int32_t> given;   ///< the number that was given to a solid
    std::vector<std::int32_t> stored;  ///< where the solid of a given number is
};

SdfBuffers buffersOf(const std::vector<kernels::SdfSolid>& solids, bool inClusters) {
    SdfBuffers buffers;
    if (!inClusters) {
        buffers.solids = solids;
        return buffers;
    }
    SdfClusters grouped = clusterSolids(solids);
    buffers.solids = std::move(grouped.solids);
    buffers.clusters = std::move(grouped.clusters);
    buffers.given = std::move(grouped.numbers);
    buffers.stored.resize(buffers.given.size());
    for (std::size_t i = 0; i < buffers.given.size(); ++i)
        buffers.stored[std::size_t(buffers.given[i])] = std::int32_t(i);
    return buffers;
}

/// Primitives: their geometry, and what they look like apart.
class SdfSceneTracer final : public SceneTracer {
public:
    SdfSceneTracer(const TracedScene& scene, bool inClusters)
        : m_inClusters(inClusters), m_data(buffersOf(scene.primitives->solids(), inClusters)) {
        m_paints = paintsOf(scene.primitives->primitives());
        m_count = std::uint32_t(m_data.solids.size());
        m_clusterCount = std::uint32_t(m_data.clusters.size());
        // As many as there may be after a move.
        m_data.clusters.resize(inClusters ? m_count : 0);
        const auto& device = scene.device.impl();
        m_solidBuffer = scene.staging.add(device, "primitives", m_data.solids);
        m_paintBuffer = scene.staging.add(device, "primitives' colours", m_paints.paints);
        m_texelBuffer = scene.staging.add(device, "colours of primitives' faces", m_paints.texels);
        m_clusterBuffer = scene.staging.add(device, "clusters of primitives", m_data.clusters);
        m_givenBuffer = scene.staging.add(device, "primitives' numbers", m_data.given);
        m_storedBuffer = scene.staging.add(device, "primitives by number", m_data.stored);
    }

    kernels::TracerBlock block() const noexcept override {
        return {{packAddress(m_solidBuffer.address()), packAddress(m_paintBuffer.address()),
                 packAddress(m_clusterBuffer.address()), packAddress(m_givenBuffer.address()),
                 packAddress(m_storedBuffer.address()), packAddress(m_texelBuffer.address())},
                {m_count, m_clusterCount}};
    }
    void recordBuild(const Recorder&) override {}
    void recordPlacements(const Recorder&, const std::vector<Placement>&) override {}
    void recordPrimitives(const Recorder& recorder, const PlacedPrimitives& primitives) override {
        const SdfBuffers moved = buffersOf(primitives.solids(), m_inClusters);
        m_clusterCount = std::uint32_t(moved.clusters.size());
        recorder.write(m_solidBuffer, std::as_bytes(std::span(moved.solids)));
        recorder.write(m_clusterBuffer, std::as_bytes(std::span(moved.clusters)));
        recorder.write(m_givenBuffer, std::as_bytes(std::span(moved.given)));
        recorder.write(m_storedBuffer, std::as_bytes(std::span(moved.stored)));
    }
    void releaseStaging() noexcept override {
        m_data = {};
        m_paints = {};
    }
    std::size_t bytes() const noexcept override {
        return m_solidBuffer.bytes() + m_paintBuffer.bytes() + m_clusterBuffer.bytes() + m_givenBuffer.bytes() +
               m_storedBuffer.bytes() + m_texelBuffer.bytes();
    }

private:
    bool m_inClusters;
    SdfBuffers m_data;
    SdfPaints m_paints;
    std::uint32_t m_count = 0, m_clusterCount = 0;
    Buffer m_solidBuffer, m_paintBuffer, m_clusterBuffer, m_givenBuffer, m_storedBuffer, m_texelBuffer;
};

bool always(const Device&) {
    return true;
}
std::unique_ptr<SceneTracer> makeInClusters(const TracedScene& scene) {
    return std::make_unique<SdfSceneTracer>(scene, true);
}

}  // namespace

std::unique_ptr<SceneTracer> makeSdfSceneTracer(const TracedScene& scene) {
    return std::make_unique<SdfSceneTracer>(scene, false);
}

const SceneTracerType& sphereTracedSdf() {
    static constexpr SceneTracerType kType{.name = "sdf",
                                           .kind = TracerKind::sdf,
                                           .needs = "",
                                           .possible = always,
                                           .preferred = always,
                                           .make = makeInClusters,
                                           .hitsTriangles = false,
                                           .shaders = shaderCode};
    return kType;
}

}  // namespace probegi::vulkan
