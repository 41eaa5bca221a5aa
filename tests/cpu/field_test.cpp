#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "kernels/random.h"
#include "probegi/field.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

const Context kContext = *Context::create({.threads = 2});

FieldSetup smallDesc() {
    FieldSetup d;
    d.volumes[0] = {{-1, -1, -1}, {0.5f, 1.0f, 0.7f}, {6, 4, 5}};
    d.raysPerProbe = 64;
    return d;
}

std::vector<RayDatum> constantData(const FieldDesc& d, glm::vec3 radiance, float distance) {
    return std::vector<RayDatum>(std::size_t(probeCount(d.volumes[0])) * d.raysPerProbe, {radiance, distance});
}

std::vector<FieldQuery> randomQueries(int count) {
    std::uint32_t state = 4;
    const auto r = [&] { return 2 * kernels::nextRandom(state) - 1; };
    std::vector<FieldQuery> queries;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 n = glm::normalize(glm::vec3(r(), r(), r()) + 1e-3f);
        queries.push_back({4.0f * glm::vec3(r(), r(), r()), n, glm::normalize(n + 0.9f * glm::vec3(r(), r(), r()))});
    }
    return queries;
}

TEST(Field, spanQueryEqualsSingleQueriesForAnyNumberOfThreads) {
    FieldSetup desc = smallDesc();
    std::vector<RayDatum> data = constantData(desc, {}, 1);
    std::uint32_t state = 8;
    for (RayDatum& d : data)
        d = {glm::vec3(kernels::nextRandom(state), kernels::nextRandom(state), 1), kernels::nextRandom(state)};
    const auto queries = randomQueries(3000);
    std::vector<glm::vec3> first;
    for (const int threads : {1, 2, 5}) {
        Field field = *Field::create(*Context::create({.threads = threads}), desc, desc);
        ASSERT_TRUE(field.update(data));
        ASSERT_TRUE(field.update(data));
        std::vector<glm::vec3> out(queries.size());
        ASSERT_TRUE(field.irradiance(queries, out));
        for (std::size_t i = 0; i < queries.size(); i += 97) EXPECT_EQ(out[i], field.irradiance(queries[i]));
        if (first.empty()) first = out;
        EXPECT_EQ(out, first);
    }
}

TEST(Field, memoryIsWithinItsBudget) {
    FieldSetup desc;
    desc.volumes[0].counts = {22, 14, 32};
    const Field field = *Field::create(kContext, desc, desc);
    EXPECT_LE(double(field.memory().persistentBytes()) / probeCount(desc), 1600.0);
    EXPECT_GE(double(field.memory().persistentBytes()) / probeCount(desc), 64 * 6 + 256 * 4);
}

// Refused before any memory is allocated: the query can address 2^32 visibility texels.
TEST(Field, moreVisibilityThanTheQueryReachesDoesNotFit) {
    FieldSetup desc;
    desc.volumes = {{{0, 0, 0}, {1, 1, 1}, {256, 256, 256}}};
    desc.visibilityTexels = 64;
    const auto field = Field::create(kContext, desc, desc);
    ASSERT_FALSE(field);
    EXPECT_EQ(field.error().code, ErrorCode::outOfMemory);
}

}  // namespace
}  // namespace probegi
