// The query of several points at a time, with every instruction set of this processor, against the same kernels with
// one point and one probe at a time.
#include <gtest/gtest.h>

#include <hwy/highway.h>
#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "cpu/field_view.h"
#include "field/layout.h"
#include "field/volume_access.h"
#include "kernels/probe/storage.h"
#include "kernels/volume/volume_choice.h"
#include "scalar_query.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

// A field with random light, random distances and some probes in walls.
class RandomField {
public:
    RandomField(LeakGuard guard, FieldRules rules, int visibilityTexels) {
        m_desc.volumes = {{.origin = {-1, 2, -3}, .spacing = {1.0f, 0.5f, 0.75f}, .counts = {5, 6, 4}}};
        m_desc.guard = guard;
        m_desc.rules = rules;
        m_desc.irradianceTexels = 8;
        m_desc.visibilityTexels = visibilityTexels;
        m_volumes = makeVolumes(m_desc);
        m_volumes[0].inverseMaxDistance = 1.0f / 2.5f;
        const std::size_t probes = kSlots;
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        m_irradiance.resize(probes * 64 * 3 + 1);
        for (std::size_t p = 0; p < probes; ++p) {
            const float light = unit(m_random) < 0.1f ? 0.0f : 4 * unit(m_random);
            for (std::size_t t = 0; t < 64 * 3; ++t)
                m_irradiance[p * 64 * 3 + t] =
                    std::uint16_t(kernels::packHalfDithered(light * (0.8f + 0.2f * unit(m_random)), 0));
            m_backfaceShare.push_back(unit(m_random) < 0.2f ? 0.2f + 0.2f * unit(m_random) : 0.0f);
        }
        // A probe's distances vary by a third only: Chebyshev's bound, cubed and crushed, amplifies the rounding of a
        // direction between texels, the more so the more they differ.
        const std::size_t texels = std::size_t(visibilityTexels * visibilityTexels);
        for (std::size_t p = 0; p < probes; ++p) {
            const float own = 0.1f + 0.5f * unit(m_random);
            for (std::size_t t = 0; t < texels; ++t) {
                const float mean = own * (0.85f + 0.3f * unit(m_random));
                const float square = mean * mean * (1.0f + 0.1f * unit(m_random));
                m_visibility.push_back(kernels::packUnorm16Dithered(mean, 0) | kernels::packUnorm16Dithered(square, 0)
                                                                                   << 16);
            }
        }
        makeMasks();
    }

    FieldView view() {
        FieldView view;
        view.volumes = m_volumes;
        view.slots = kSlots;
        view.irradianceTexels = m_desc.irradianceTexels;
        view.visibilityTexels = m_desc.visibilityTexels;
        view.selfShadowBias = m_desc.selfShadowBias;
        view.guard = m_desc.guard;
        view.rules = m_desc.rules;
        view.irradiance = m_irradiance.data();
        view.visibility = m_visibility.data();
        view.backfaceShare = m_backfaceShare.data();
        view.maskWords = m_masks.data();
        view.maskTexels = kMaskTexels;
        view.irradianceTaps = &m_irradianceTaps;
        view.visibilityTaps = &m_visibilityTaps;
        return view;
    }

    // In and around the grid; a third of the normals are along an axis.
    std::vector<FieldQuery> points(std::size_t count) {
        std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
        const auto direction = [&] {
            return glm::normalize(glm::vec3(unit(m_random), unit(m_random), unit(m_random)));
        };
        std::vector<FieldQuery> points;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 place(unit(m_random), unit(m_random), unit(m_random));
            glm::vec3 normal = direction();
            if (i % 3 == 0) {
                const int axis = int(i / 3 % 3);
                normal = glm::vec3(0.0f);
                normal[axis] = i % 2 == 0 ? 1.0f : -1.0f;
            }
            points.push_back({glm::vec3(1, 3.25f, -1.9f) + place * glm::vec3(2.5f, 1.8f, 1.6f), normal, direction()});
        }
        return points;
    }

    test::FieldSetup& desc() { return m_desc; }
    std::vector<kernels::Volume>& volumes() { return m_volumes; }
    std::vector<float>& backfaceShare() { return m_backfaceShare; }

private:
    static constexpr int kSlots = 3 * 5 * 6 * 4;  // for up to three volumes
    static constexpr int kMaskTexels = 3, kCubeWords = 27, kCubes = 9;

    // Eight clusters; a third of the cubes sees all, another nothing, the others what chance has it.
    void makeMasks() {
        std::mt19937 random(11);
        for (int slot = 0; slot < kSlots; ++slot) {
            m_masks.push_back(std::uint32_t(2 * kSlots + kCubeWords * (slot % kCubes)));
            m_masks.push_back(std::uint32_t(random()) & 0x3f07u);
        }
        for (int cube = 0; cube < kCubes; ++cube)
            for (int word = 0; word < kCubeWords; ++word)
                m_masks.push_back(cube % 3 == 0 ? ~0u : cube % 3 == 1 ? 0u : std::uint32_t(random()));
    }

    std::mt19937 m_random{7};
    test::FieldSetup m_desc;
    std::vector<kernels::Volume> m_volumes;
    std::vector<std::uint16_t> m_irradiance;
    std::vector<std::uint32_t> m_visibility;
    std::vector<float> m_backfaceShare;
    std::vector<std::uint32_t> m_masks;
    TapTable m_irradianceTaps = makeTapTable(8), m_visibilityTaps;

public:
    void makeVisibilityTaps() { m_visibilityTaps = makeTapTable(m_desc.visibilityTexels); }
};

void expectScalarAnswers(RandomField& field, const char* what) {
    field.makeVisibilityTaps();
    const std::vector<FieldQuery> points = field.points(997);  // not a multiple of any number of lanes
    std::vector<glm::vec3> abreast(points.size()), scalar(points.size());
    bench::queryScalar(field.view(), points, scalar);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        std::fill(abreast.begin(), abreast.end(), glm::vec3(-1.0f));
        queryIrradiance(field.view(), points, abreast);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::vec3 bound = 2e-4f * scalar[i] + 1e-6f;
            const glm::vec3 difference = glm::abs(abreast[i] - scalar[i]);
            wrong += difference.x <= bound.x && difference.y <= bound.y && difference.z <= bound.z ? 0 : 1;
        }
        EXPECT_EQ(wrong, 0u) << what << " with " << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
}

TEST(QueryLanes, answerAsOnePointAtATime) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper})
        for (const LeakGuard guard : {LeakGuard::moments, LeakGuard::none, LeakGuard::masks})
            for (const int texels : {16, 8}) {
                RandomField field(guard, rules, texels);
                expectScalarAnswers(field, rules == FieldRules::paper ? "the paper's rules" : "the measured rules");
            }
}

// All cages are in walls: every result comes from farther away or is black.
TEST(QueryLanes, answersFromFartherAwayAsOneAtATime) {
    RandomField field(LeakGuard::moments, FieldRules::measured, 16);
    for (std::size_t i = 0; i < field.backfaceShare().size(); ++i) field.backfaceShare()[i] = i % 7 == 0 ? 0.27f : 1.0f;
    expectScalarAnswers(field, "probes in walls");
}

// A turned and scrolled volume that does not have the pool's first slots. With this rotation no point is so near a
// layer of probes that its small weights depend on rounding.
TEST(QueryLanes, answerInTurnedVolumesAsOneAtATime) {
    for (const LeakGuard guard : {LeakGuard::moments, LeakGuard::none, LeakGuard::masks}) {
        RandomField field(guard, FieldRules::measured, 16);
        kernels::Volume& volume = field.volumes()[0];
        volume.phase = {3, 5, 2};
        volume.firstSlot = 120;
        expectScalarAnswers(field, "scrolled");
        volume.turned = 1;
        volume.orientation = glm::normalize(glm::vec4(0.2f, -0.6f, 0.3f, 0.7f));
        expectScalarAnswers(field, "turned and scrolled");
    }
}

// Where one volume alone answers, its own bits; points outside all volumes go to the nearest.
TEST(QueryLanes, eachPointIsAnsweredByItsVolume) {
    RandomField field(LeakGuard::moments, FieldRules::measured, 16);
    field.makeVisibilityTaps();
    kernels::Volume second = field.volumes()[0], third = second;
    second.origin += glm::vec3(3, 0.3f, 0.2f);
    second.firstSlot = 120;
    third.origin += glm::vec3(-2, 0.7f, 0.1f);
    third.firstSlot = 240;
    third.turned = 1;
    third.orientation = glm::normalize(glm::vec4(0, 0.4f, 0.1f, 0.9f));
    const std::vector<kernels::Volume> all = {field.volumes()[0], second, third};
    std::vector<FieldQuery> points = field.points(997);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].position.x += float(i % 3) * 3.0f - 3.0f;
    std::vector<glm::vec3> together(points.size());
    field.volumes() = all;
    queryIrradiance(field.view(), points, together);
    std::array<int, 3> answered{};
    int blended = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto shares = sharesOfVolumes({all, {}}, points[i].position);
        if (std::ranges::count(shares, 1.0f) != 1) {
            ++blended;
            continue;
        }
        kernels::VolumeChoice choice = kernels::noVolume();
        for (int v = 0; v < 3; ++v) choice = kernels::chooseVolume(choice, all[std::size_t(v)], v, points[i].position);
        field.volumes() = {all[std::size_t(choice.volume)]};
        glm::vec3 alone;
        queryIrradiance(field.view(), {&points[i], 1}, {&alone, 1});
        EXPECT_EQ(alone, together[i]) << i;
        EXPECT_EQ(shares[std::size_t(choice.volume)], 1.0f) << i;
        ++answered[std::size_t(choice.volume)];
    }
    EXPECT_GT(blended, 50);
    for (const int count : answered) EXPECT_GT(count, 100);
}

// A point's result does not depend on the others in its block.
TEST(QueryLanes, aPointsNeighboursDoNotMatter) {
    RandomField field(LeakGuard::moments, FieldRules::measured, 16);
    field.makeVisibilityTaps();
    const std::vector<FieldQuery> points = field.points(300);
    std::vector<glm::vec3> together(points.size());
    queryIrradiance(field.view(), points, together);
    for (std::size_t i = 0; i < points.size(); ++i) {
        glm::vec3 alone;
        queryIrradiance(field.view(), {&points[i], 1}, {&alone, 1});
        EXPECT_EQ(alone, together[i]) << i;
    }
}

TEST(QueryLanes, saysWhatItRunsWith) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        EXPECT_EQ(instructionSet(), hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace probegi
