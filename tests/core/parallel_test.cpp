#include "core/parallel.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace probegi {
namespace {

#ifdef PROBEGI_HAS_MXCSR
// A product below the smallest normal number; 0 if denormals are flushed.
float denormalProduct() {
    volatile float small = std::numeric_limits<float>::min();
    return small * 0.25f;
}

class ParallelFor : public testing::TestWithParam<int> {};

TEST_P(ParallelFor, TasksFlushDenormals) {
    const Context context = Context::create({.threads = GetParam()}).value();
    std::vector<float> seen(64, -1.0f);
    parallelFor(context, seen.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) seen[i] = denormalProduct();
    });
    EXPECT_EQ(seen, std::vector<float>(64, 0.0f));
}

TEST_P(ParallelFor, TheCallersModeComesBack) {
    const Context context = Context::create({.threads = GetParam()}).value();
    parallelFor(context, 64, 1, [](std::size_t, std::size_t) {});
    EXPECT_GT(denormalProduct(), 0.0f);
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(1, 4));
#endif

}  // namespace
}  // namespace probegi
