// Paths into the open from probe to probe.
#include "cpu/solid_probes.h"

#include <gtest/gtest.h>

#include "cpu/field_view.h"
#include "field/control_impl.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

// 5 x 4 x 3 probes a metre apart that see `free` metres in every direction, all doubtful and with trusted paths.
struct Volume {
    FieldSetup desc;
    std::vector<std::uint32_t> visibility;
    std::vector<kernels::ProbeSides> sides;
    TapTable taps = makeTapTable(8);

    explicit Volume(float free) {
        desc.volumes = {{glm::vec3(0.0f), glm::vec3(1.0f), {5, 4, 3}}};
        desc.visibilityTexels = 8;
        const auto bits = std::uint32_t(free / 4 * 65535);
        visibility.assign(60 * 64, bits | bits << 16);
        sides.assign(60, {0.5f, 0.5f, kernels::kNoWayOut, kernels::kNoWayOut, kernels::kMostTrust});
    }
    void find() {
        FieldView view;
        view.slots = 60;
        view.visibilityTexels = desc.visibilityTexels;
        view.visibility = visibility.data();
        view.visibilityTaps = &taps;
        std::vector<kernels::Volume> volumes = makeVolumes(desc);
        volumes[0].inverseMaxDistance = 0.25f;
        view.volumes = volumes;
        const FieldControl control = makeFieldControl(desc, desc);
        findSolidProbes(*Context::create({.threads = 2}), view, control.tasks(), sides);
    }
    static std::size_t at(int x, int y, int z) { return std::size_t(x + 5 * (y + 4 * z)); }
};

// The neighbours of a probe in the open find it if they are at most `free` / 0.8 away.
TEST(SolidProbes, aWayMustBeFree) {
    for (const auto& [free, reach] : {std::pair{0.7f, 0}, {0.9f, 1}, {1.2f, 2}, {1.45f, 3}}) {
        Volume v(free);
        v.sides[Volume::at(2, 2, 1)] = {0, 0.9f, 0, 0, 0};
        v.find();
        for (int z = 0; z < 3; ++z)
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 5; ++x) {
                    const glm::ivec3 apart = glm::abs(glm::ivec3(x, y, z) - glm::ivec3(2, 2, 1));
                    const int axes = apart.x + apart.y + apart.z;
                    const bool near = apart.x < 2 && apart.y < 2 && apart.z < 2;
                    const std::uint32_t steps = axes == 0 ? 0u : (near && axes <= reach ? 1u : kernels::kNoWayOut);
                    EXPECT_EQ(v.sides[Volume::at(x, y, z)].nextSteps, steps) << free << ": " << x << y << z;
                }
    }
}

TEST(SolidProbes, theShortestWayCounts) {
    Volume v(4);
    v.sides[Volume::at(0, 0, 0)].steps = 5;
    v.sides[Volume::at(2, 2, 2)].steps = 3;
    v.sides[Volume::at(4, 3, 0)].steps = kernels::kLongestWay;
    v.find();
    EXPECT_EQ(v.sides[Volume::at(1, 1, 1)].nextSteps, 4u);
    EXPECT_EQ(v.sides[Volume::at(0, 1, 0)].nextSteps, 6u);
    EXPECT_EQ(v.sides[Volume::at(4, 3, 1)].nextSteps, kernels::kNoWayOut) << "too long a way";
    EXPECT_EQ(v.sides[Volume::at(1, 1, 1)].steps, kernels::kNoWayOut) << "for the coming update, not for this one";
    EXPECT_EQ(v.sides[Volume::at(1, 1, 1)].trust, kernels::kMostTrust);
    EXPECT_EQ(v.sides[Volume::at(4, 3, 2)].trust, kernels::kMostTrust - 1);
}

// A wall half way, seen by one of the two, blocks the path.
TEST(SolidProbes, bothMustSeeTheWayFree) {
    for (const int blind : {1, 2}) {
        Volume v(1.5f);
        v.sides[Volume::at(2, 0, 0)] = {0, 0.9f, 0, 0, 0};
        for (std::size_t t = 0; t < 64; ++t) v.visibility[Volume::at(blind, 0, 0) * 64 + t] = 0x10001000u;
        v.find();
        EXPECT_EQ(v.sides[Volume::at(1, 0, 0)].nextSteps, kernels::kNoWayOut) << blind;
        EXPECT_EQ(v.sides[Volume::at(3, 0, 0)].nextSteps, blind == 2 ? kernels::kNoWayOut : 1u) << blind;
    }
}

// Only doubtful probes look for a path.
TEST(SolidProbes, wallsAndRoomsDoNotLook) {
    Volume v(4);
    v.sides[Volume::at(0, 0, 0)] = {0, 0.9f, 0, 0, 0};
    v.sides[Volume::at(1, 0, 0)] = {0.9f, 0, 3, 3, 9};
    v.find();
    EXPECT_EQ(v.sides[Volume::at(1, 0, 0)].nextSteps, kernels::kNoWayOut);
    EXPECT_EQ(v.sides[Volume::at(1, 0, 0)].trust, 0u);
    EXPECT_EQ(v.sides[Volume::at(0, 0, 0)].nextSteps, 0u);
}

}  // namespace
}  // namespace probegi
