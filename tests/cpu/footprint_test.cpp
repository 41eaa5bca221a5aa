// Reading one probe's maps: at texel centres, between them, across edges, along the grid's axes.
#include "cpu/footprint.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "cpu/field_access.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/storage.h"
#include "kernels/random.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

constexpr int kProbes = 8;

// Random texels in maps of 6 x 6 (irradiance) and 10 x 10 (moments).
struct Maps {
    FieldSetup desc;
    std::vector<std::uint16_t> irradiance;
    std::vector<std::uint32_t> visibility;
    TapTable irradianceTaps = makeTapTable(6), visibilityTaps = makeTapTable(10);

    Maps() {
        desc.irradianceTexels = 6;
        desc.visibilityTexels = 10;
        std::uint32_t state = 3;
        for (int i = 0; i < kProbes * 36 * 3; ++i)
            irradiance.push_back(std::uint16_t(kernels::packHalfDithered(0.5f + kernels::nextRandom(state), 0)));
        for (int i = 0; i < kProbes * 100; ++i) visibility.push_back(kernels::hashUint(std::uint32_t(i)));
    }
    FieldView view() const {
        FieldView v;
        v.irradianceTexels = desc.irradianceTexels;
        v.visibilityTexels = desc.visibilityTexels;
        v.irradiance = irradiance.data();
        v.visibility = visibility.data();
        v.irradianceTaps = &irradianceTaps;
        v.visibilityTaps = &visibilityTaps;
        return v;
    }
};

TEST(Footprint, isTheTexelAtItsCentre) {
    const Maps maps;
    for (int probe = 0; probe < kProbes; ++probe) {
        for (int t = 0; t < 36; ++t) {
            const FieldView view = maps.view();
            const FieldAccess access(view);
            const glm::vec3 e =
                storedIrradiance(access, probe, irradiancePoint(access, kernels::octTexelDirection(t % 6, t / 6, 6)));
            for (int c = 0; c < 3; ++c) {
                const float stored = kernels::unpackHalf(maps.irradiance[std::size_t(3 * (probe * 36 + t) + c)]);
                EXPECT_NEAR(e[c] / stored, 1, 2e-5f) << probe << ' ' << t;
            }
        }
        for (int t = 0; t < 100; ++t) {
            const glm::vec2 m = probeMoments(maps.view(), probe, kernels::octTexelDirection(t % 10, t / 10, 10));
            const std::uint32_t bits = maps.visibility[std::size_t(probe * 100 + t)];
            EXPECT_NEAR(m.x, float(bits & 0xffffu) / 65535, 1e-5f);
            EXPECT_NEAR(m.y, float(bits >> 16) / 65535, 1e-5f);
        }
    }
}

TEST(Footprint, betweenTexelsIsBilinear) {
    const TapTable taps = makeTapTable(10);
    const glm::vec3 direction = kernels::octDecode({(3.25f + 0.5f) / 5 - 1, (6.125f + 0.5f) / 5 - 1});
    const Footprint f = footprintOf(taps, 10, direction);
    const std::uint32_t offsets[] = {63, 64, 73, 74};
    const float weights[] = {0.75f * 0.875f, 0.25f * 0.875f, 0.75f * 0.125f, 0.25f * 0.125f};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(f.offset[i], offsets[i]);
        EXPECT_NEAR(f.weight[i], weights[i], 1e-5f);
    }
}

// Texels continue across the edges as on the octahedron, so results are continuous over the sphere.
TEST(Footprint, isContinuousOverTheWholeSphere) {
    const Maps maps;
    std::uint32_t state = 9;
    for (int i = 0; i < 3000; ++i) {
        glm::vec3 a(kernels::nextRandom(state), kernels::nextRandom(state), kernels::nextRandom(state));
        a = glm::normalize(a - 0.5f);
        if (i % 3 == 0) a = glm::normalize(glm::vec3(a.x, a.y, -0.01f * std::abs(a.z)));  // near the square's edges
        if (i % 3 == 1) a = glm::normalize(glm::vec3(a.x, 1e-3f * a.y, -std::abs(a.z)));
        const glm::vec3 b =
            glm::normalize(a + 1e-4f * glm::vec3(kernels::nextRandom(state), kernels::nextRandom(state), 0));
        EXPECT_LT(glm::length(probeMoments(maps.view(), 3, a) - probeMoments(maps.view(), 3, b)), 5e-3f) << i;
    }
}

TEST(Footprint, axesLieBetweenFourTexels) {
    for (const int size : {8, 10}) {
        const TapTable taps = makeTapTable(size);
        for (int axis = 0; axis < 3; ++axis)
            for (const bool up : {false, true}) {
                const AxisTexels& texels = axisTexels(taps, size, axis, up);
                glm::vec3 mean(0.0f);
                for (const std::uint16_t t : texels)
                    mean += kernels::octTexelDirection(t % size, t / size, size) / 4.0f;
                EXPECT_NEAR(glm::normalize(mean)[axis], up ? 1 : -1, 1e-5f) << size << ' ' << axis;
                EXPECT_GT(glm::length(mean), 0.9f);
            }
    }
}

}  // namespace
}  // namespace probegi
