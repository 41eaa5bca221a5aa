#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>
#include <mutex>

#include "cpu/embree_packets.h"
#include "cpu/embree_scene.h"
#include "geometry/emitters.h"
#include "geometry/surface_shader.h"
#include "probegi/tracer.h"

namespace probegi {

namespace {

/// Maximum distance between origins of coherent rays, in scene diagonals.
constexpr float kCoherentSpread = 1.0f / 64.0f;

/// Hits per block: the texels of all are prefetched before the first is shaded.
constexpr std::size_t kFetchAhead = 16;

class EmbreeTracer final : public MovableTracer {
public:
    EmbreeTracer(const Context& context, const Scene& scene, std::unique_ptr<EmbreeScene> traced,
                 EmitterGeometry emitters)
        : m_context(context),
          m_source(scene),
          m_scene(std::move(traced)),
          m_emitterGeometry(std::move(emitters)),
          m_emitters(m_emitterGeometry.placed()) {
        measure();
    }

    Result<void> closestHits(std::span<const Ray> rays, std::span<Hit> hits) const override {
        assert(rays.size() == hits.size());
        packets().closestHits(rays, hits);
        return {};
    }

    Result<void> occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
        assert(rays.size() == blocked.size());
        packets().occluded(rays, blocked);
        return {};
    }

    Result<void> surfaces(std::span<const Ray> rays, std::span<const Hit> hits, std::span<Surface> out) const override {
        assert(rays.size() == hits.size() && rays.size() == out.size());
        const std::vector<SurfaceMaterial>& materials = m_scene->geometry().materials;
        for (std::size_t begin = 0; begin < rays.size(); begin += kFetchAhead) {
            const std::size_t end = std::min(begin + kFetchAhead, rays.size());
            for (std::size_t i = begin; i < end; ++i)
                if (hits[i].valid()) fetchAhead(meshOf(hits[i]), materials, hits[i]);
            for (std::size_t i = begin; i < end; ++i)
                if (hits[i].valid()) out[i] = surface(rays[i], hits[i], materials, 0);
        }
        return {};
    }

    Result<void> filteredSurfaces(std::span<const Ray> rays, std::span<const Hit> hits, float spread,
                                  std::span<Surface> out) const override {
        assert(rays.size() == hits.size() && rays.size() == out.size());
        // Only pictures need mip levels. The first call makes them, even one without rays.
        std::call_once(m_filteredOnce, [&] {
            m_mips = MipMaps(m_context, m_source);
            m_filtered = makeSurfaceMaterials(m_source, m_mips);
        });
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (hits[i].valid()) out[i] = surface(rays[i], hits[i], m_filtered, spread);
        return {};
    }

    Result<void> setPose(const ScenePose& pose) override {
        if (auto placed = m_scene->place(pose); !placed) return placed;
        bool lamps = false;
        for (const Placement& p : m_scene->geometry().placements)
            lamps = m_emitterGeometry.place(p.node, p.toWorld) || lamps;
        if (lamps) m_emitters = m_emitterGeometry.placed();
        measure();
        return {};
    }

    Bounds bounds() const override { return m_scene->bounds(); }
    const EmitterSet* emitters() const override { return &m_emitters; }

private:
    EmbreePackets packets() const { return {m_scene->handle(), m_originSpread, m_scene->instanced()}; }

    const SurfaceMesh& meshOf(const Hit& hit) const {
        const SceneGeometry& geometry = m_scene->geometry();
        return (hit.instance < 0 ? geometry.world : geometry.group(m_scene->placement(hit.instance)))
            .mesh(hit.geometry);
    }

    Surface surface(const Ray& ray, const Hit& hit, std::span<const SurfaceMaterial> materials, float spread) const {
        const SceneGeometry& geometry = m_scene->geometry();
        if (hit.instance < 0) return shadeHit(geometry.world.mesh(hit.geometry), materials, hit, ray.direction, spread);
        const Placement& placement = m_scene->placement(hit.instance);
        return shadeHit(geometry.group(placement).mesh(hit.geometry), materials, hit, ray.direction, placement.toWorld,
                        placement.normalToWorld, spread);
    }

    void measure() { m_originSpread = kCoherentSpread * glm::length(m_scene->bounds().size()); }

    Context m_context;
    const Scene& m_source;
    std::unique_ptr<EmbreeScene> m_scene;
    EmitterGeometry m_emitterGeometry;
    EmitterSet m_emitters;
    float m_originSpread = 0;
    mutable std::once_flag m_filteredOnce;
    mutable MipMaps m_mips;
    mutable std::vector<SurfaceMaterial> m_filtered;  // with mip levels
};

Result<std::unique_ptr<MovableTracer>> make(const Context& context, const Scene& scene, const ScenePose& pose,
                                            const InstancePredicate& movable) {
    return EmbreeScene::create(context, scene, pose, movable).transform([&](std::unique_ptr<EmbreeScene> made) {
        return std::unique_ptr<MovableTracer>(
            std::make_unique<EmbreeTracer>(context, scene, std::move(made), EmitterGeometry(scene, pose)));
    });
}

}  // namespace

Result<std::unique_ptr<Tracer>> makeEmbreeTracer(const Context& context, const Scene& scene, const ScenePose& pose) {
    return make(context, scene, pose, {}).transform([](std::unique_ptr<MovableTracer> made) {
        return std::unique_ptr<Tracer>(std::move(made));
    });
}

Result<std::unique_ptr<MovableTracer>> makeMovableEmbreeTracer(const Context& context, const Scene& scene,
                                                               const ScenePose& pose, const MovableDesc& desc) {
    if (auto checked = checkNodes(scene, desc.nodes, "MovableDesc::nodes"); !checked) return checked.error();
    return make(context, scene, pose, movableInstances(scene, desc.animated, desc.nodes));
}

}  // namespace probegi
