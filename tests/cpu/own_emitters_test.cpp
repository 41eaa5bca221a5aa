// A tracer without triangles that reports its emitters: on average, samples of them contribute the same as its rays.
#include <gtest/gtest.h>

#include "probegi/field.h"
#include "support/analytic_tracer.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr glm::vec3 kCorner{-0.15f, 2, -0.15f}, kAlong{0.3f, 0, 0}, kAcross{0, 0, 0.3f};

/// A square lamp that faces down.
class LampTracer final : public AnalyticTracer {
public:
    explicit LampTracer(bool tells) : m_tells(tells) {
        Material lamp;
        lamp.emission = glm::vec3(20.0f);
        lamp.baseColor = {0, 0, 0, 1};
        materials.push_back(lamp);
        addQuad(kCorner, kAlong, kAcross, 0);
        EmissiveTriangle near, far;
        near.corner = kCorner, near.edge1 = kAlong, near.edge2 = kAcross;
        far.corner = kCorner + kAlong + kAcross, far.edge1 = -kAlong, far.edge2 = -kAcross;
        near.material = far.material = 0;
        m_set = makeEmitterSet({near, far}, {20.0f});
    }
    const EmitterSet* emitters() const override { return m_tells ? &m_set : nullptr; }

private:
    EmitterSet m_set;
    bool m_tells;
};

float upwards(bool tells, int updates) {
    FieldSetup desc;
    desc.volumes = {{{-0.5f, 0, -0.5f}, glm::vec3(0.9f), {2, 2, 2}}};
    Field field = *Field::create(*Context::create({.threads = 1}), desc, desc);
    EXPECT_TRUE(field.converge(LampTracer(tells), {}, 1e-9f, updates));
    float sum = 0;
    for (int probe = 0; probe < 8; ++probe) sum += probeIrradiance(field, probe, {0, 1, 0}).x;
    return sum;
}

TEST(OwnEmitters, samplesContributeAsMuchAsRaysOnAverage) {
    const float byRays = upwards(false, 4000), byLooks = upwards(true, 4000), atOnce = upwards(true, 1);
    EXPECT_NEAR(byLooks / byRays, 1.0f, 0.01f);
    EXPECT_NEAR(atOnce / byLooks, 1.0f, 0.03f);
    EXPECT_GT(byLooks, 1.0f);
}

}  // namespace
}  // namespace probegi::test
