// Fields against each other, with light that is known.
#include <gmock/gmock.h>

#include "probegi/measure.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

/// A field of 27 probes whose maps hold E = pi everywhere, but for one probe's, which hold `other` times as much.
FieldSnapshot lit(float other = 1, std::uint64_t seed = 1) {
    FieldDesc desc;
    desc.volumes[0].counts = {3, 3, 3};
    desc.raysPerProbe = 16;
    desc.fixedRays = 0;
    desc.seed = seed;
    Field field = *Field::create(*Context::create({.threads = 1}), desc);
    std::vector<RayDatum> data;
    for (const ProbeTask& task : field.control().tasks())
        data.insert(data.end(), 16, {glm::vec3(task.slot == 13 ? other : 1.0f), 1.0f});
    EXPECT_TRUE(field.update(data));
    return *field.read();
}

TEST(CompareFields, equalOnesAreEqual) {
    const FieldDifference same = *compareFields(lit(), lit());
    EXPECT_EQ(same.mean, 1);
    EXPECT_EQ(same.rms, 0);
    EXPECT_EQ(same.worst, 0);
    EXPECT_EQ(same.ratio.median, 1);
    EXPECT_EQ(same.probes, 27);
    EXPECT_TRUE(same.equalMaps);
    EXPECT_TRUE(same.equalStates);
}

TEST(CompareFields, oneProbeWithTwiceTheLight) {
    const FieldDifference d = *compareFields(lit(2), lit(1));
    EXPECT_NEAR(d.mean, 28.0 / 27, 2e-3);
    EXPECT_NEAR(d.rms, std::sqrt(1.0 / 27), 2e-3);  // a difference of pi in one of 27, over pi
    EXPECT_NEAR(d.worst, 1, 0.02);
    EXPECT_EQ(d.worstSlot, 13);
    EXPECT_NEAR(d.ratio.median, 1, 5e-3);
    EXPECT_NEAR(d.ratio.high, 1, 5e-3);
    EXPECT_FALSE(d.equalMaps);
    const FieldDifference other = *compareFields(lit(1), lit(2));
    EXPECT_NEAR(other.mean, 27.0 / 28, 2e-3);
    EXPECT_NEAR(other.worst, 0.5, 0.01);
}

TEST(CompareFields, statesAloneMayDiffer) {
    FieldSnapshot a = lit();
    a.states[3].trust ^= 1u;
    const FieldDifference d = *compareFields(a, lit());
    EXPECT_TRUE(d.equalMaps);
    EXPECT_FALSE(d.equalStates);
    EXPECT_EQ(d.rms, 0);
}

TEST(CompareFields, probesInWallsDoNotCount) {
    FieldSnapshot a = lit(2);
    a.states[13].backfaceShare = 0.6f;
    const FieldDifference d = *compareFields(a, lit());
    EXPECT_EQ(d.probes, 26);
    EXPECT_NEAR(d.worst, 0, 5e-3);
    EXPECT_NEAR(d.mean, 1, 1e-3);
}

TEST(CompareFields, blackFieldsHaveNoRatio) {
    FieldDesc desc;
    Field field = *Field::create(*Context::create({.threads = 1}), desc);
    const FieldSnapshot black = *field.read();
    const FieldDifference d = *compareFields(black, black);
    EXPECT_EQ(d.mean, 0);
    EXPECT_EQ(d.worstSlot, -1);
    EXPECT_TRUE(d.equalMaps);
}

TEST(CompareFields, whatCannotBeComparedIsRefused) {
    const FieldSnapshot good = lit();
    const auto complaint = [&](const auto& spoil) {
        FieldSnapshot bad = lit();
        spoil(bad);
        const auto compared = compareFields(good, bad);
        return compared ? std::string() : compared.error().message;
    };
    EXPECT_THAT(complaint([](FieldSnapshot& s) { s.desc.volumes[0].spacing.x = 2; }), HasSubstr("other places"));
    EXPECT_THAT(complaint([](FieldSnapshot& s) { s.scrolled[0].x = 2; }), HasSubstr("other places"));
    EXPECT_THAT(complaint([](FieldSnapshot& s) { s.desc.irradianceTexels = 4; }), HasSubstr("maps of 8 and 16"));
    EXPECT_THAT(complaint([](FieldSnapshot& s) { s.slots.count = 5; }), HasSubstr("lacks some"));
    EXPECT_THAT(complaint([](FieldSnapshot& s) { s.states.pop_back(); }), HasSubstr("states"));
    EXPECT_THAT(complaint([](FieldSnapshot& s) { s.irradiance.resize(5); }), HasSubstr("irradiance"));
    EXPECT_THAT(complaint([](FieldSnapshot& s) { s.visibility.clear(); }), HasSubstr("visibility"));
    EXPECT_THAT(complaint([](FieldSnapshot& s) { s.desc.raysPerProbe = 0; }), HasSubstr("raysPerProbe is 0"));
}

}  // namespace
}  // namespace probegi::test
