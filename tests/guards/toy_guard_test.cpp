// A guard made of one kernel header and one row of the list, on every backend through the public API.
#include <glm/geometric.hpp>
#include <random>

#include "support/backends.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;
constexpr LeakGuard kToy{4};  // the row in list/kernels/guards/list.h

class ToyGuard : public testing::TestWithParam<BackendMaker> {
protected:
    void SetUp() override {
        if (!GetParam().possible()) GTEST_SKIP() << "this device has no ray query";
    }
    // Probes with even slots are dim, the others a hundred times as bright.
    static std::vector<RayDatum> stripes(const FieldDesc& desc) {
        std::vector<RayDatum> rays;
        for (int probe = 0; probe < probeCount(desc); ++probe)
            rays.insert(rays.end(), std::size_t(desc.raysPerProbe), {glm::vec3(probe % 2 == 0 ? 1.0f : 100.0f), 5.0f});
        return rays;
    }
    std::vector<glm::vec3> answers(LeakGuard guard) const {
        FieldSetup desc;
        desc.volumes = {{.origin = glm::vec3(0), .spacing = glm::vec3(1), .counts = {4, 5, 6}}};
        desc.raysPerProbe = 32;
        desc.guard = guard;
        const Context context = *Context::create({.threads = 2});
        auto field = GetParam().makeField(context, desc);
        EXPECT_TRUE(field) << field.error().message;
        EXPECT_TRUE(field->update(stripes(desc)));
        std::mt19937 random(1);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        std::vector<FieldQuery> queries(500);
        for (FieldQuery& q : queries) {
            q.position = glm::vec3(3, 4, 5) * glm::vec3(unit(random), unit(random), unit(random));
            q.normal = glm::normalize(glm::vec3(unit(random), unit(random), unit(random)) - 0.5f);
        }
        std::vector<glm::vec3> out(queries.size());
        EXPECT_TRUE(field->irradiance(queries, out));
        return out;
    }
};
INSTANTIATE_TEST_SUITE_P(All, ToyGuard, testing::ValuesIn(backendMakers()), nameOf<BackendMaker>);

TEST_P(ToyGuard, onlyItsProbesAnswer) {
    for (const glm::vec3& e : answers(kToy)) EXPECT_NEAR(e.x, kPi, 1e-3f);
}

TEST_P(ToyGuard, theLibrarysGuardsAreAsBefore) {
    for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
        float most = 0;
        for (const glm::vec3& e : answers(guard)) most = std::max(most, e.x);
        EXPECT_GT(most, 10 * kPi);
    }
}

}  // namespace
}  // namespace probegi::test
