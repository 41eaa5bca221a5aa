#include "vulkan/tracers/scene_tracer.h"

namespace probegi::vulkan {

namespace {

/// Primitives: 48 bytes of geometry each, which every ray reads, and what they look like apart.
class SdfSceneTracer final : public SceneTracer {
public:
    explicit SdfSceneTracer(const TracedScene& scene) : m_solids(scene.primitives->solids()) {
        for (const SdfPrimitive& primitive : scene.primitives->primitives())
            m_paints.push_back({primitive.albedo, primitive.emission});
        m_count = std::uint32_t(m_solids.size());
        m_solidBuffer = scene.staging.add(scene.device.impl(), "primitives", m_solids);
        m_paintBuffer = scene.staging.add(scene.device.impl(), "primitives' colours", m_paints);
    }

    kernels::TracerBlock block() const noexcept override {
        return {{packAddress(m_solidBuffer.address()), packAddress(m_paintBuffer.address())}, {m_count}};
    }
    void recordBuild(const Recorder&) override {}
    void recordPlacements(const Recorder&, const std::vector<Placement>&) override {}
    void recordPrimitives(const Recorder& recorder, const PlacedPrimitives& primitives) override {
        recorder.write(m_solidBuffer, std::as_bytes(std::span(primitives.solids())));
    }
    void releaseStaging() noexcept override {
        m_solids = {};
        m_paints = {};
    }
    std::size_t bytes() const noexcept override { return m_solidBuffer.bytes() + m_paintBuffer.bytes(); }

private:
    std::vector<kernels::SdfSolid> m_solids;
    std::vector<kernels::SdfPaint> m_paints;
    std::uint32_t m_count = 0;
    Buffer m_solidBuffer, m_paintBuffer;
};

}  // namespace

std::unique_ptr<SceneTracer> makeSdfSceneTracer(const TracedScene& scene) {
    return std::make_unique<SdfSceneTracer>(scene);
}

}  // namespace probegi::vulkan
