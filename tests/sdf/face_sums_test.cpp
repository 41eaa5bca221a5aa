#include "sdf/fit/face_sums.h"

#include <gtest/gtest.h>

#include "sdf/fit_scenes.h"
#include "sdf/solid.h"

namespace probegi {
namespace {

constexpr std::size_t kPerFace = 36;
const glm::vec3 kGrey(0.5f), kRed(0.9f, 0.1f, 0.1f);

/// A cube of 2 m: texels of a third of a metre.
kernels::SdfSolid cube() {
    return makeSolid(test::boxBetween(glm::vec3(-1), glm::vec3(1)));
}

TEST(FaceSums, isTheMeanOfWhatWasSeenAtATexel) {
    FaceSums sums;
    // In texel (4, 1) of the face +X, whose rows run along Y.
    const glm::vec3 point(1, -1 + 4.5f / 3, -1 + 1.5f / 3);
    sums.add(cube(), point, glm::vec3(0.2f));
    sums.add(cube(), point, glm::vec3(0.4f));
    // In the first texel of its last row.
    sums.add(cube(), {1, -0.9f, 0.9f}, kRed);
    const std::vector<glm::vec3> means = sums.means(kGrey);
    ASSERT_EQ(means.size(), 6 * kPerFace);
    EXPECT_NEAR(means[kPerFace + 6 + 4].x, 0.3f, 1e-6f);
    EXPECT_EQ(means[kPerFace + 30], kRed);
}

TEST(FaceSums, spreadsOverAFaceAndLeavesTheOthers) {
    FaceSums sums;
    sums.add(cube(), {0.9f, 1, -0.9f}, kRed);
    const std::vector<glm::vec3> means = sums.means(kGrey);
    ASSERT_EQ(means.size(), 6 * kPerFace);
    for (std::size_t i = 0; i < means.size(); ++i) {
        const glm::vec3 expected = i / kPerFace == 3 ? kRed : kGrey;
        EXPECT_NEAR(means[i].x, expected.x, 1e-5f) << i;
        EXPECT_NEAR(means[i].y, expected.y, 1e-5f) << i;
    }
}

TEST(FaceSums, isEmptyWhereFacesHaveOneColour) {
    FaceSums sums;
    EXPECT_TRUE(sums.means(kGrey).empty());
    sums.add(cube(), {1, 0.1f, 0.1f}, kGrey + 0.005f);
    EXPECT_TRUE(sums.means(kGrey).empty());
}

}  // namespace
}  // namespace probegi
