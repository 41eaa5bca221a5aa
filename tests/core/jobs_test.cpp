// Loops on an engine's own job system (ContextDesc::parallelFor).
#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "core/parallel.h"
#include "support/jobs.h"

namespace probegi {
namespace {

using test::Jobs;

std::vector<int> visits(const Context& context, std::size_t count, std::size_t grain) {
    std::vector<int> visited(count, 0);
    parallelFor(context, count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visited[i];
    });
    return visited;
}

TEST(Jobs, ALoopRunsOnTheEnginesThreads) {
    Jobs jobs;
    const Context context = Context::create({.threads = 4, .parallelFor = jobs.callback()}).value();
    EXPECT_EQ(context.threads(), 4);
    EXPECT_EQ(visits(context, 1000, 7), std::vector<int>(1000, 1));
    EXPECT_EQ(jobs.loops, 1);
    std::atomic<bool> here{false};
    const auto me = std::this_thread::get_id();
    parallelFor(context, 16, 1, [&](std::size_t, std::size_t) {
        if (std::this_thread::get_id() == me) here = true;
    });
    EXPECT_FALSE(here);
}

TEST(Jobs, OneThreadOrOneRangeNeedsNone) {
    Jobs jobs;
    const Context one = Context::create({.threads = 1, .parallelFor = jobs.callback()}).value();
    EXPECT_EQ(visits(one, 100, 10), std::vector<int>(100, 1));
    const Context four = Context::create({.threads = 4, .parallelFor = jobs.callback()}).value();
    EXPECT_EQ(visits(four, 10, 10), std::vector<int>(10, 1));
    EXPECT_TRUE(visits(four, 0, 10).empty());
    EXPECT_EQ(jobs.loops, 0);
}

TEST(Jobs, ALoopWithinALoopStaysOnItsThread) {
    Jobs jobs;
    const Context context = Context::create({.threads = 4, .parallelFor = jobs.callback()}).value();
    std::atomic<int> sum{0};
    parallelFor(context, 8, 1, [&](std::size_t, std::size_t) {
        const auto me = std::this_thread::get_id();
        parallelFor(context, 8, 1, [&](std::size_t, std::size_t) {
            if (std::this_thread::get_id() == me) ++sum;
        });
    });
    EXPECT_EQ(sum, 64);
    EXPECT_EQ(jobs.loops, 1);
    EXPECT_FALSE(jobs.nested);
    EXPECT_EQ(visits(context, 8, 1), std::vector<int>(8, 1));  // afterwards the engine's jobs are used again
    EXPECT_EQ(jobs.loops, 2);
}

TEST(Jobs, WhatATaskThrowsIsThrownToTheCaller) {
    Jobs jobs;
    const Context context = Context::create({.threads = 4, .parallelFor = jobs.callback()}).value();
    std::atomic<int> done{0};
    const auto run = [&] {
        parallelFor(context, 20, 1, [&](std::size_t begin, std::size_t) {
            ++done;
            if (begin == 13) throw std::runtime_error("thirteen");
        });
    };
    EXPECT_THROW(run(), std::runtime_error);
    EXPECT_EQ(done, 20);
}

TEST(TryParallelFor, TheErrorOfARangeComesBack) {
    Jobs jobs;
    for (const Context& context : {Context::create({.threads = 1}).value(), Context::create({.threads = 4}).value(),
                                   Context::create({.threads = 4, .parallelFor = jobs.callback()}).value()}) {
        const auto failing = [](std::size_t begin, std::size_t) -> Result<void> {
            if (begin == 5) return fail(ErrorCode::deviceLost, "five");
            return {};
        };
        const auto done = tryParallelFor(context, 20, 1, failing);
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().code, ErrorCode::deviceLost);
        EXPECT_EQ(done.error().message, "five");
        EXPECT_TRUE(tryParallelFor(context, 5, 1, failing));
    }
}

}  // namespace
}  // namespace probegi
