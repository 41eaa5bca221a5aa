// Any number of threads may share a tracer, and it does not change their floating-point modes.
#include <cstring>
#include <limits>
#include <thread>

#include "tracer/tracer_scene.h"

namespace probegi::test {

class TracerThreads : public EveryTracer {};
PROBEGI_ON_EVERY_TRACER(TracerThreads);

TEST_P(TracerThreads, ManyAtOnceGetTheSameAnswers) {
    std::mt19937 random(41);
    TestScene s;
    s.add(innerBox(4, random));
    const auto tracer = trace(GetParam(), s);
    std::vector<Ray> rays(20000);
    for (Ray& ray : rays) ray = rayAlong(randomPoint(random, 0.9f), randomDirection(random));
    std::vector<std::vector<Hit>> hits(4, std::vector<Hit>(rays.size()));
    std::vector<std::thread> threads;
    for (std::vector<Hit>& mine : hits) threads.emplace_back([&] { tracer->closestHits(rays, mine).value(); });
    for (std::thread& thread : threads) thread.join();
    for (const std::vector<Hit>& mine : hits)
        EXPECT_EQ(std::memcmp(mine.data(), hits[0].data(), mine.size() * sizeof(Hit)), 0);
}

TEST_P(TracerThreads, TheCallersDenormalModeIsKept) {
    TestScene s;
    s.add(quad());
    shoot(*trace(GetParam(), s), rayAlong({0, 1, 0}, {0, -1, 0}));
    volatile float tiny = std::numeric_limits<float>::min();
    EXPECT_GT(tiny * 0.5f, 0.0f);
}

}  // namespace probegi::test
