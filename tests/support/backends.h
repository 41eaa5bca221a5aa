#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <span>
#include <vector>

#include "io/image_codec.h"
#include "probegi/probegi.h"
#include "support/field_setup.h"
#include "support/tracers.h"

namespace probegi::test {

/// Where passes run. A new backend is one line in backends(), and all tests of tests/backend run on it.
struct Backend {
    const char* name;
    Result<Field> (*makeField)(const Context&, const FieldSetup&);
    Result<std::unique_ptr<Tracer>> (*makeTracer)(const Context&, const Scene&, const ScenePose&);
    Result<RenderedPicture> (*renderPicture)(const Context&, const Tracer&, const Lighting&, const Field*,
                                             const PictureDesc&);
    Result<std::vector<std::uint8_t>> (*toneMap)(const HdrImage&, const ToneMap&);
    bool (*possible)();  ///< whether this machine can run it

    friend std::ostream& operator<<(std::ostream& out, const Backend& backend) { return out << backend.name; }
};

/// What vulkan::toneMapImage does, as a PNG has it.
inline Result<std::vector<std::uint8_t>> toneMapOnCpu(const HdrImage& image, const ToneMap& toneMap) {
    return io::decodeTexture(io::encodePng(image, toneMap)).rgba;
}

/// The reference of all others.
inline const Backend kCpu{"cpu",
                          [](const Context& context, const FieldSetup& setup) { return setup.make(context); },
                          makeEmbreeTracer,
                          renderPicture,
                          toneMapOnCpu,
                          [] { return true; }};

#ifdef PROBEGI_TEST_VULKAN
/// The Vulkan backend with one of its tracers.
template <vulkan::TracerKind kind>
Backend vulkanBackend(const char* name, bool (*possible)()) {
    return {name,
            [](const Context& context, const FieldSetup& setup) {
                return vulkan::makeField(context, testDevice(), setup, setup);
            },
            makeVulkanTracer<kind>,
            [](const Context& context, const Tracer& tracer, const Lighting& lighting, const Field* field,
               const PictureDesc& desc) {
                return vulkan::renderPicture(context, testDevice(), tracer, lighting, field, desc);
            },
            [](const HdrImage& image, const ToneMap& toneMap) {
                return vulkan::toneMapImage(testDevice(), image, toneMap);
            },
            possible};
}
#endif

inline std::span<const Backend> backends() {
    static const Backend all[] = {
        kCpu,
#ifdef PROBEGI_TEST_VULKAN
        vulkanBackend<vulkan::TracerKind::bvh>("vulkanBvh", [] { return true; }),
        vulkanBackend<vulkan::TracerKind::rayQuery>("vulkanRayQuery", [] { return testDevice().rayQuery(); }),
#endif
    };
    return all;
}

}  // namespace probegi::test
