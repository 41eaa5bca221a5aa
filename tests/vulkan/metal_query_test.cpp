// probegi/query.metal, compiled as C++ with a small stand-in for Metal's library: the translation is complete, lays out
// the field's constants as the library does, and asks the field as the other languages do.
#ifdef PROBEGI_QUERY_METAL

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "field/control_impl.h"
#include "field/layout.h"
#include "field/volume_access.h"
#include "kernels/abi/field_constants.h"
#include "kernels/lookup/probe_query.h"
#include "kernels/probe/solid_probe.h"
#include "vulkan/metal/metal_stdlib"

namespace probegi::test::msl {
#include "probegi/query.metal"
}
#undef thread
#undef constant
#undef device

namespace probegi::test {
namespace {

static_assert(sizeof(msl::ProbegiConstants) == sizeof(kernels::FieldConstants));

// A field whose probes all see radiance 2 from all sides, one cell away.
struct ConstantField {
    ConstantField() {
        desc.volumes[0] = {.origin = {-1, 2, 0}, .spacing = {1, 0.5f, 2}, .counts = {4, 5, 3}};
        const FieldControl control = makeFieldControl(desc, {});
        const FieldControl::Impl& books = control.impl();
        kernels::FieldConstants c{.volumeCount = 1,
                                  .guard = 1,
                                  .rules = kernels::kRulesMeasured,
                                  .selfShadowBias = 0.3f,
                                  .irradianceTexels = desc.irradianceTexels,
                                  .visibilityTexels = desc.visibilityTexels,
                                  .tiles = {.rowShift = 3, .layerShift = 8},
                                  .irradianceTexelSize = glm::vec2(1.0f / 80.0f),
                                  .visibilityTexelSize = glm::vec2(1.0f / 144.0f),
                                  .volumes = {books.volumes[0]},
                                  .blending = {},
                                  .rays = books.raySet(0),
                                  .masks = {},
                                  .maskTexels = 2,
                                  .maskPacked = 0,
                                  .blockers = {},
                                  .blockerCount = 0};
        std::memcpy(static_cast<void*>(&constants), &c, sizeof c);
        words.assign(std::size_t(1 + 2 * probeCount(desc)), 0u);  // no backs, all on the lattice
        for (std::size_t i = 2; i < words.size(); i += 2) words[i] = std::uint32_t(ProbeActivity::vigilant);
        directions.assign(control.rayDirections().begin(), control.rayDirections().end());
        fixedDirections.assign(control.fixedRayDirections().begin(), control.fixedRayDirections().end());
    }
    const msl::ProbegiStates& states() const { return *reinterpret_cast<const msl::ProbegiStates*>(words.data()); }

    FieldDesc desc;
    msl::ProbegiConstants constants;
    std::vector<std::uint32_t> words;
    std::vector<glm::vec3> directions, fixedDirections;
};

TEST(MetalQuery, aConstantFieldIsConstant) {
    const ConstantField field;
    metal::texture2d_array<float> irradiance{metal::float4(std::pow(2.0f, 0.2f))}, visibility{metal::float4(0.5f)};
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (int i = 0; i < 50; ++i) {
        const metal::float3 point(glm::vec3(-1, 2, 0) +
                                  glm::vec3(3 * unit(random), 2 * unit(random), 4 * unit(random)));
        const metal::float3 normal(glm::normalize(glm::vec3(unit(random), unit(random), unit(random)) - 0.5f));
        const glm::vec3 e = msl::probegiIrradiance(point, normal, normal, field.constants, field.states(), visibility,
                                                   {}, irradiance, {});
        EXPECT_NEAR(e.x, 2 * M_PI, 1e-4) << i;
        EXPECT_NEAR(e.z, 2 * M_PI, 1e-4) << i;
        EXPECT_EQ(msl::probegiCoverage(point, field.constants), 1.0f) << i;
        EXPECT_EQ(msl::probegiVolumeAt(point, field.constants), 0);
    }
    EXPECT_EQ(msl::probegiCoverage(metal::float3(-1, 2, 12), field.constants), 0.0f);
}

TEST(MetalQuery, probesAndRaysAreTheFields) {
    const ConstantField field;
    ASSERT_EQ(msl::probegiProbeCount(field.constants), 60);
    EXPECT_EQ(glm::vec3(msl::probegiProbePosition(33, field.constants, field.states())), glm::vec3(0, 3.5f, 2));
    ASSERT_EQ(msl::probegiRayCount(field.constants), int(field.directions.size()));
    ASSERT_EQ(msl::probegiFixedRayCount(field.constants), int(field.fixedDirections.size()));
    const auto near = [](const glm::vec3& a, const glm::vec3& b) { return glm::distance(a, b) < 1e-6f; };
    for (int i = 0; i < 144; ++i)
        EXPECT_TRUE(near(msl::probegiRayDirection(i, field.constants), field.directions[std::size_t(i)])) << i;
    for (int i = 0; i < 16; ++i)
        EXPECT_TRUE(near(msl::probegiFixedRayDirection(i, field.constants), field.fixedDirections[std::size_t(i)]))
            << i;
    const RayDatum back{{-0.25f, -3.0f, -0.5f}, -4.0f};
    const PackedRayDatum packed = packRay(back);
    const metal::uint2 words = msl::probegiPackRay(metal::float3(back.radiance), back.distance);
    EXPECT_EQ(words.x, packed.radiance);
    EXPECT_EQ(words.y, std::bit_cast<std::uint32_t>(packed.distance));
}

}  // namespace
}  // namespace probegi::test

#endif
