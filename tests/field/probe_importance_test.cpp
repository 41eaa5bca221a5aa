#include "field/probe_importance.h"

#include <gtest/gtest.h>

#include "field/layout.h"

namespace probegi {
namespace {

kernels::Volume volumeOfSpacing(float spacing) {
    FieldDesc desc;
    desc.volumes[0].spacing = glm::vec3(spacing);
    return makeVolumes(desc)[0];
}

TEST(ProbeImportance, isTheSameForAllWhereNoOneLooks) {
    const ProbeImportance importance(std::nullopt, {});
    EXPECT_EQ(importance.at(volumeOfSpacing(1), glm::vec3(0)), 1.0f);
    EXPECT_EQ(importance.at(volumeOfSpacing(1), glm::vec3(1e6f)), 1.0f);
}

TEST(ProbeImportance, fallsWithTheDistanceInCells) {
    FieldSettings settings;
    settings.camera = glm::vec3(1, 2, 3);
    const ProbeImportance importance(std::nullopt, settings);
    for (const float spacing : {0.01f, 1.0f, 100.0f}) {
        const auto at = [&](float cells) {
            return importance.at(volumeOfSpacing(spacing), *settings.camera + glm::vec3(0, 0, cells * spacing));
        };
        EXPECT_NEAR(at(0), 1.0f, 1e-6f);
        EXPECT_NEAR(at(8), 0.05f + 0.95f / 2, 1e-3f);
        EXPECT_GT(at(3), at(4));
        EXPECT_NEAR(at(1e4f), 0.05f, 1e-3f) << "what is far is not forgotten";
    }
}

// A right pyramid of view along -z, 90 degrees high and twice as wide.
TEST(ProbeImportance, isMoreInView) {
    BudgetView view;
    view.camera.yfov = 1.5707963f;
    view.aspect = 2;
    const ProbeImportance importance(view, {});
    FieldSettings settings;
    settings.camera = view.camera.position;
    const ProbeImportance blind(std::nullopt, settings);
    const kernels::Volume volume = volumeOfSpacing(0.01f);
    const auto share = [&](glm::vec3 p) { return importance.at(volume, p) / blind.at(volume, p); };
    EXPECT_NEAR(share({0, 0, -5}), 1.0f, 1e-5f);
    EXPECT_NEAR(share({0, 0, 5}), 0.25f, 1e-5f) << "behind";
    EXPECT_NEAR(share({0, 4.9f, -5}), 1.0f, 1e-5f);
    EXPECT_NEAR(share({0, -5.1f, -5}), 0.25f, 1e-5f);
    EXPECT_NEAR(share({9.9f, 0, -5}), 1.0f, 1e-5f);
    EXPECT_NEAR(share({-10.1f, 0, -5}), 0.25f, 1e-5f);
    // 1.5 cells around it matter: 0.015 from the upper face, whose normal is at 45 degrees.
    EXPECT_NEAR(share({0, 5.02f, -5}), 1.0f, 1e-5f);
    EXPECT_NEAR(share({0, 0, 0.01f}), 1.0f, 1e-5f) << "where the viewer stands";
    EXPECT_NEAR(share({0, 0, 0.02f}), 0.25f, 1e-5f);
}

}  // namespace
}  // namespace probegi
