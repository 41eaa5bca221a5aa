#pragma once

#include <glm/geometric.hpp>

#include "support/backends.h"
#include "support/field_setup.h"

namespace probegi::test {

/// What a test of tests/backend needs to run on any backend.
class EveryBackend : public testing::TestWithParam<BackendMaker> {
protected:
    void SetUp() override {
        if (!GetParam().possible()) GTEST_SKIP() << "this device has no ray query";
    }
    Field makeField(const FieldSetup& setup) const { return made(GetParam().makeField(context, setup)); }
    std::unique_ptr<Tracer> makeTracer(const Scene& scene, const ScenePose& pose) const {
        return made(GetParam().makeTracer(context, scene, pose));
    }
    /// Answers of a field, all at once.
    static std::vector<glm::vec3> ask(const Field& field, std::span<const FieldQuery> queries) {
        std::vector<glm::vec3> answers(queries.size());
        const auto asked = field.irradiance(queries, answers);
        EXPECT_TRUE(asked) << asked.error().message;
        return answers;
    }
    template <class T>
    static T made(Result<T> result) {
        if (!result) throw std::runtime_error(result.error().message);  // fails the test
        return std::move(*result);
    }

    const Context context = *Context::create({.threads = 2});
};

/// Once for each fixture that derives from EveryBackend.
#define PROBEGI_ON_EVERY_BACKEND(Fixture) \
    INSTANTIATE_TEST_SUITE_P(All, Fixture, testing::ValuesIn(backendMakers()), nameOf<BackendMaker>)

/// A grid of 6 x 4 x 5 probes with cells that are no cubes.
FieldSetup smallDesc();
/// The same datum for all rays of all probes.
std::vector<RayDatum> constantData(const FieldDesc& desc, glm::vec3 radiance, float distance);
/// Radiance over two decades, distances up to 3 m, every seventh ray on a backface.
std::vector<RayDatum> randomData(const FieldDesc& desc, std::uint32_t seed);
/// Light for fixed rays, `scale` times what it is for the same seed and scale 1.
std::vector<FixedRayDatum> randomFixedData(const FieldDesc& desc, std::uint32_t seed, float scale);
/// The grid moved a little: from a probe in the very plane of a wall, rounding decides which of its rays hit the wall.
inline VolumeDesc offTheWalls(VolumeDesc grid) {
    grid.origin += grid.spacing * glm::vec3(0.037f, 0.053f, 0.041f);
    return grid;
}

/// Points in smallDesc()'s grid and up to two metres around it, all normals, viewers on the normal's side and not.
std::vector<FieldQuery> randomQueries(int count, std::uint32_t seed = 4);
/// Probes' directions of texel centres: x, y of a map of `size` texels.
glm::vec3 texelDirection(int texel, int size);

/// The stored value of an irradiance texel: what FieldSnapshot::probeIrradiance() says, encoded.
float storedIrradiance(const Field& field, int probe, int texel, int channel);

/// How the texels of two fields differ, in steps of the storage: half floats of (mean radiance)^(1/5), and 16-bit
/// fractions of the farthest distance.
struct AtlasDifference {
    double worstIrradiance = 0;
    double worstVisibility = 0;
    double worstBackfaceShare = 0;   ///< absolute
    double differingIrradiance = 0;  ///< share of the texels' channels more than half a step apart
    double differingVisibility = 0;
};
AtlasDifference compareAtlases(const Field& a, const Field& b);

/// "Same rays in, same atlases out". Storage is dithered: where the means differ in their last bits, the dither takes
/// some of them to neighbouring steps.
void expectSameAtlases(const Field& field, const Field& reference);

}  // namespace probegi::test
