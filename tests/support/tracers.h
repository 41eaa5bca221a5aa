#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <span>

#include "probegi/tracer.h"
#ifdef PROBEGI_TEST_VULKAN
#include "probegi/vulkan.h"
#include "support/vulkan_device.h"
#endif

namespace probegi::test {

/// One way to make a Tracer. A new tracer is one line in tracerMakers(), and all tests of tracers run on it.
struct TracerMaker {
    const char* name;
    Result<std::unique_ptr<Tracer>> (*make)(const Context&, const Scene&, const ScenePose&);
    bool (*possible)();  ///< whether this machine can run it; where not, make() must refuse
    /// Shares of rays aimed exactly at edges and at vertices of a closed mesh that may get through.
    double edgeLoss = 0, vertexLoss = 0.003;
    bool tellsInstances = false;  ///< Hit::instance is the number of a placement, or -1 where meshes were merged
    /// The same with what can move; null: nothing can.
    Result<std::unique_ptr<MovableTracer>> (*makeMovable)(const Context&, const Scene&, const ScenePose&,
                                                          const MovableDesc&) = nullptr;

    friend std::ostream& operator<<(std::ostream& out, const TracerMaker& maker) { return out << maker.name; }
};

#ifdef PROBEGI_TEST_VULKAN
template <vulkan::TracerKind kind>
Result<std::unique_ptr<Tracer>> makeVulkanTracer(const Context& context, const Scene& scene, const ScenePose& pose) {
    return vulkan::makeTracer(context, testDevice(), scene, pose, {.tracer = kind});
}
template <vulkan::TracerKind kind>
Result<std::unique_ptr<MovableTracer>> makeMovableVulkanTracer(const Context& context, const Scene& scene,
                                                               const ScenePose& pose, const MovableDesc& movable) {
    return vulkan::makeMovableTracer(context, testDevice(), scene, pose, movable, kind);
}
#endif

inline Result<std::unique_ptr<Tracer>> makeMovable(const Context& context, const Scene& scene, const ScenePose& pose) {
    return makeMovableEmbreeTracer(context, scene, pose).transform([](std::unique_ptr<MovableTracer> made) {
        return std::unique_ptr<Tracer>(std::move(made));
    });
}

inline std::span<const TracerMaker> tracerMakers() {
    static const TracerMaker makers[] = {
        {"embree", makeEmbreeTracer, [] { return true; }, 0, 0.003, true, makeMovableEmbreeTracer},
        {"embreeMovable", makeMovable, [] { return true; }, 0, 0.003, true},
#ifdef PROBEGI_TEST_VULKAN
        {"vulkanBvh", makeVulkanTracer<vulkan::TracerKind::bvh>, [] { return true; }, 0, 0, false,
         makeMovableVulkanTracer<vulkan::TracerKind::bvh>},
        {"vulkanRayQuery", makeVulkanTracer<vulkan::TracerKind::rayQuery>, [] { return testDevice().rayQuery(); },
         // The driver's: Vulkan recommends watertight intersection and does not demand it. Mesa 25.0's software device
         // was measured to lose 7e-5 at edges and 0.6 % at vertices.
         3e-4, 0.012, false, makeMovableVulkanTracer<vulkan::TracerKind::rayQuery>},
#endif
    };
    return makers;
}

template <class Named>
std::string nameOf(const testing::TestParamInfo<Named>& info) {
    return info.param.name;
}

/// Fixture of tests that every tracer has to pass. On a device without what the tracer needs, the test is that it
/// says so.
class EveryTracer : public testing::TestWithParam<TracerMaker> {
protected:
    void SetUp() override {
        if (GetParam().possible()) return;
        const Scene empty;
        const auto refused = GetParam().make(*Context::create(), empty, poseAt(empty));
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
        GTEST_SKIP() << refused.error().message;
    }

    std::unique_ptr<Tracer> make(const Scene& scene, const ScenePose& pose, int threads = 1) const {
        auto tracer = GetParam().make(*Context::create({.threads = threads}), scene, pose);
        if (!tracer) throw std::runtime_error(tracer.error().message);  // fails the test
        return std::move(*tracer);
    }
};

/// Once in each folder of tests that uses EveryTracer.
#define PROBEGI_ON_EVERY_TRACER(Fixture) \
    INSTANTIATE_TEST_SUITE_P(All, Fixture, testing::ValuesIn(tracerMakers()), nameOf<TracerMaker>)

}  // namespace probegi::test
