#include <cassert>

#include "cpu/embree_float_mode.h"
#include "cpu/embree_scene.h"
#include "cpu/surface_shader.h"
#include "probegi/tracer.h"

namespace probegi {

namespace {

RTCRay toEmbree(const Ray& ray) {
    return {ray.origin.x,    ray.origin.y,    ray.origin.z, ray.near, ray.direction.x, ray.direction.y,
            ray.direction.z, 0.0f /* time */, ray.far,      ~0u,      0 /* id */,      0 /* flags */};
}

class EmbreeTracer final : public Tracer {
public:
    explicit EmbreeTracer(std::unique_ptr<EmbreeScene> scene) : m_scene(std::move(scene)) {}

    void closestHits(std::span<const Ray> rays, std::span<Hit> hits) const override {
        assert(rays.size() == hits.size());
        const EmbreeFloatMode floatMode;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            query.ray = toEmbree(rays[i]);
            query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(m_scene->handle(), &context, &query);
            if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
                hits[i] = Hit();
            else
                hits[i] = {query.ray.tfar,
                           std::int32_t(query.hit.primID),
                           std::int32_t(query.hit.geomID),
                           std::int32_t(query.hit.instID[0]),
                           {query.hit.u, query.hit.v}};
        }
    }

    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
        assert(rays.size() == blocked.size());
        const EmbreeFloatMode floatMode;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            RTCRay ray = toEmbree(rays[i]);
            rtcOccluded1(m_scene->handle(), &context, &ray);
            blocked[i] = ray.tfar < 0.0f ? 1 : 0;
        }
    }

    void surfaces(std::span<const Ray> rays, std::span<const Hit> hits, std::span<Surface> out) const override {
        assert(rays.size() == hits.size() && rays.size() == out.size());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Hit& hit = hits[i];
            if (!hit.valid()) continue;
            if (hit.instance < 0) {
                out[i] = shadeHit(m_scene->world().mesh(hit.geometry), m_scene->materials(), hit, rays[i].direction);
                continue;
            }
            const EmbreeScene::Placement& placement = m_scene->placement(hit.instance);
            out[i] = shadeHit(m_scene->group(placement).mesh(hit.geometry), m_scene->materials(), hit,
                              rays[i].direction, placement.toWorld, placement.normalToWorld);
        }
    }

    Bounds bounds() const override { return m_scene->bounds(); }

private:
    std::unique_ptr<EmbreeScene> m_scene;
};

}  // namespace

Result<std::unique_ptr<Tracer>> makeEmbreeTracer(const Context& context, const Scene& scene, const ScenePose& pose) {
    return EmbreeScene::create(context, scene, pose).map([](std::unique_ptr<EmbreeScene> made) {
        return std::unique_ptr<Tracer>(std::make_unique<EmbreeTracer>(std::move(made)));
    });
}

}  // namespace probegi
