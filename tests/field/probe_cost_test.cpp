#include "field/probe_cost.h"

#include <gtest/gtest.h>

#include <limits>

namespace probegi {
namespace {

TEST(ProbeCost, settlesWhereUpdatesTakeTheBudget) {
    for (const double fixed : {0.0, 2.0})
        for (const double each : {0.001, 0.02, 3.0}) {
            ProbeCost cost;
            double took = 0;
            for (int update = 0; update < 60; ++update) {
                const std::size_t probes = cost.affordable(10);
                took = fixed + each * double(probes);
                cost.report(took, probes);
            }
            EXPECT_NEAR(took, 10, each < 1 ? 0.5 : 3.0) << fixed << " " << each;
        }
}

TEST(ProbeCost, growsByTwoAtMostAndKeepsOne) {
    ProbeCost cost;
    EXPECT_EQ(cost.affordable(10), 64u);
    cost.report(1e-6, 64);
    EXPECT_EQ(cost.affordable(10), 128u);
    cost.report(1e6, 64);
    cost.report(1e6, 64);
    cost.report(1e6, 1);
    for (int i = 0; i < 60; ++i) cost.report(1e6, 1);
    EXPECT_EQ(cost.affordable(10), 1u);
}

TEST(ProbeCost, oneSlowUpdateChangesLittle) {
    ProbeCost cost;
    for (int i = 0; i < 20; ++i) cost.report(10, 100);
    cost.report(10000, 100);
    EXPECT_GT(cost.affordable(10), 50u);
    EXPECT_LT(cost.affordable(10), 100u);
}

TEST(ProbeCost, whatIsNoTimeIsNotCounted) {
    ProbeCost cost;
    cost.report(5, 0);
    cost.report(0, 5);
    cost.report(-1, 5);
    cost.report(std::numeric_limits<double>::infinity(), 5);
    cost.report(std::numeric_limits<double>::quiet_NaN(), 5);
    EXPECT_EQ(cost.affordable(10), 64u);
}

}  // namespace
}  // namespace probegi
