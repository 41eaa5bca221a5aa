#include <cassert>
#include <glm/geometric.hpp>

#include "cpu/embree_packets.h"
#include "cpu/embree_scene.h"
#include "probegi/tracer.h"
#include "surface/emitters.h"
#include "surface/surface_shader.h"

namespace probegi {

namespace {

/// Of the scene's diagonal: how far apart the origins of coherent rays may be.
constexpr float kCoherentSpread = 1.0f / 64.0f;

class EmbreeTracer final : public Tracer {
public:
    EmbreeTracer(std::unique_ptr<EmbreeScene> scene, EmitterSet emitters)
        : m_scene(std::move(scene)),
          m_emitters(std::move(emitters)),
          m_originSpread(kCoherentSpread * glm::length(m_scene->bounds().size())) {}

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
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (hits[i].valid()) out[i] = surface(rays[i], hits[i]);
        return {};
    }

    Bounds bounds() const override { return m_scene->bounds(); }
    const EmitterSet* emitters() const override { return &m_emitters; }

private:
    EmbreePackets packets() const { return {m_scene->handle(), m_originSpread, m_scene->instanced()}; }

    Surface surface(const Ray& ray, const Hit& hit) const {
        const SceneGeometry& geometry = m_scene->geometry();
        if (hit.instance < 0)
            return shadeHit(geometry.world.mesh(hit.geometry), geometry.materials, hit, ray.direction);
        const Placement& placement = m_scene->placement(hit.instance);
        return shadeHit(geometry.group(placement).mesh(hit.geometry), geometry.materials, hit, ray.direction,
                        placement.toWorld, placement.normalToWorld);
    }

    std::unique_ptr<EmbreeScene> m_scene;
    EmitterSet m_emitters;
    float m_originSpread;
};

}  // namespace

Result<std::unique_ptr<Tracer>> makeEmbreeTracer(const Context& context, const Scene& scene, const ScenePose& pose) {
    return EmbreeScene::create(context, scene, pose).transform([&](std::unique_ptr<EmbreeScene> made) {
        return std::unique_ptr<Tracer>(
            std::make_unique<EmbreeTracer>(std::move(made), EmitterGeometry(scene, pose).placed()));
    });
}

}  // namespace probegi
