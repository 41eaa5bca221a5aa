#include <cassert>
#include <new>

#include "core/float_mode.h"
#include "cpu/sdf_lanes.h"
#include "kernels/sdf/union_hit.h"
#include "probegi/sdf.h"
#include "sdf/paints.h"
#include "sdf/placed_primitives.h"
#include "sdf/sdf_emitters.h"

namespace probegi {

namespace {

class SdfTracer final : public MovableTracer {
public:
    explicit SdfTracer(PlacedPrimitives placed)
        : m_placed(std::move(placed)),
          m_paints(paintsOf(m_placed.primitives())),
          m_lanes(m_placed.solids()),
          m_emitters(emittersOf(m_placed.primitives(), m_placed.solids())) {}

    Result<void> closestHits(std::span<const Ray> rays, std::span<Hit> hits) const override {
        assert(rays.size() == hits.size());
        const FloatMode floatMode;
        sdfClosestHits(m_lanes, rays, hits);
        return {};
    }

    Result<void> occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
        assert(rays.size() == blocked.size());
        const FloatMode floatMode;
        sdfOccluded(m_lanes, rays, blocked);
        return {};
    }

    Result<void> surfaces(std::span<const Ray> rays, std::span<const Hit> hits, std::span<Surface> out) const override {
        assert(rays.size() == hits.size() && rays.size() == out.size());
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (hits[i].valid()) out[i] = surface(rays[i], hits[i]);
        return {};
    }

    Result<void> setPose(const ScenePose& pose) override {
        if (auto moved = m_placed.setPose(pose); !moved) return moved;
        m_lanes = SdfLanes(m_placed.solids());
        m_emitters = emittersOf(m_placed.primitives(), m_placed.solids());
        return {};
    }

    Bounds bounds() const override { return m_placed.bounds(); }
    const EmitterSet* emitters() const override { return m_emitters.empty() ? nullptr : &m_emitters; }

private:
    Surface surface(const Ray& ray, const Hit& hit) const {
        const auto number = std::size_t(hit.primitive);
        const kernels::SdfPaint& paint = m_paints.paints[number];
        const kernels::SdfSolid& solid = m_placed.solids()[number];
        const bool within = hit.geometry == kernels::kSdfFromWithin;
        Surface s;
        s.position = ray.origin + ray.direction * hit.distance;
        const glm::vec3 normal = kernels::sdfSurfaceNormal(solid, s.position);
        s.geometricNormal = within ? -normal : normal;
        s.shadingNormal = kernels::bendTowards(s.geometricNormal, -ray.direction);
        s.albedo = paint.faces < 0 ? paint.albedo : faceColour(solid, paint.faces, s.position);
        if (!within) s.emission = paint.emission;
        s.material = emitterMaterial(m_emitters, number);
        s.back = s.backface = within;
        return s;
    }

    glm::vec3 faceColour(const kernels::SdfSolid& solid, int faces, glm::vec3 position) const {
        const kernels::SdfFacePoint at = kernels::sdfFacePointAt(solid, position);
        const std::uint32_t* texel = m_paints.texels.data() + faces + at.first;
        return kernels::sdfFaceColour(at, texel[0], texel[1], texel[kSdfFaceSide], texel[kSdfFaceSide + 1]);
    }

    PlacedPrimitives m_placed;
    SdfPaints m_paints;
    SdfLanes m_lanes;
    EmitterSet m_emitters;
};

}  // namespace

Result<std::unique_ptr<MovableTracer>> makeSdfTracer(const Context&, const SdfScene& sdf, const Scene& scene,
                                                     const ScenePose& pose) {
    try {
        return PlacedPrimitives::create(sdf, scene, pose).transform([](PlacedPrimitives placed) {
            return std::unique_ptr<MovableTracer>(std::make_unique<SdfTracer>(std::move(placed)));
        });
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::outOfMemory, "not enough memory for the primitives' tracer; use fewer primitives");
    }
}

}  // namespace probegi
