#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <span>

#include "probegi/sdf.h"
#ifdef PROBEGI_TEST_VULKAN
#include "probegi/vulkan.h"
#include "support/vulkan_device.h"
#endif

namespace probegi::test {

/// One way to trace primitives. All tests of such tracers run on it.
struct SdfTracerMaker {
    const char* name;
    Result<std::unique_ptr<MovableTracer>> (*make)(const Context&, const SdfScene&, const Scene&, const ScenePose&);

    friend std::ostream& operator<<(std::ostream& out, const SdfTracerMaker& maker) { return out << maker.name; }
};

#ifdef PROBEGI_TEST_VULKAN
inline Result<std::unique_ptr<MovableTracer>> makeVulkanSdfTracer(const Context& context, const SdfScene& sdf,
                                                                  const Scene& scene, const ScenePose& pose) {
    return vulkan::makeSdfTracer(context, testDevice(), sdf, scene, pose);
}
#endif

inline std::span<const SdfTracerMaker> sdfTracerMakers() {
    static const SdfTracerMaker makers[] = {
        {"cpu", makeSdfTracer},
#ifdef PROBEGI_TEST_VULKAN
        {"vulkan", makeVulkanSdfTracer},
#endif
    };
    return makers;
}

/// Fixture of tests that every tracer of primitives has to pass.
class EverySdfTracer : public testing::TestWithParam<SdfTracerMaker> {
protected:
    std::unique_ptr<MovableTracer> make(const SdfScene& sdf, const Scene& scene = {}) const {
        auto tracer = GetParam().make(*Context::create({.threads = 1}), sdf, scene, poseAt(scene));
        if (!tracer) throw std::runtime_error(tracer.error().message);  // fails the test
        return std::move(*tracer);
    }
};

}  // namespace probegi::test
