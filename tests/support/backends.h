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

/// One way to make a Backend. A new backend is one line in backendMakers(), and all tests of tests/backend run on it.
struct BackendMaker {
    const char* name;
    Result<std::unique_ptr<Backend>> (*open)(const Context&);
    Result<std::vector<std::uint8_t>> (*toneMap)(const HdrImage&, const ToneMap&);
    bool (*possible)();  ///< whether this machine can run it

    /// What tests ask of a backend most.
    Result<Field> makeField(const Context& context, const FieldSetup& setup) const {
        return open(context).and_then([&](const auto& backend) { return backend->makeField(setup, setup); });
    }
    Result<std::unique_ptr<Tracer>> makeTracer(const Context& context, const Scene& scene,
                                               const ScenePose& pose) const {
        return open(context).and_then([&](const auto& backend) { return backend->openScene(scene, pose); });
    }
    Result<RenderedPicture> renderPicture(const Context& context, const Tracer& tracer, const Lighting& lighting,
                                          const Field* field, const PictureDesc& desc) const {
        return open(context)
            .and_then([](const auto& backend) { return backend->makeRenderer(); })
            .and_then([&](const auto& renderer) { return renderer->render(tracer, lighting, field, desc); });
    }

    friend std::ostream& operator<<(std::ostream& out, const BackendMaker& maker) { return out << maker.name; }
};

/// What vulkan::toneMapImage does, as a PNG has it.
inline Result<std::vector<std::uint8_t>> toneMapOnCpu(const HdrImage& image, const ToneMap& toneMap) {
    return io::decodeTexture(io::encodePng(image, toneMap)).rgba;
}

/// The reference of all others.
inline const BackendMaker kCpu{"cpu", [](const Context& context) { return openBackend(context); }, toneMapOnCpu,
                               [] { return true; }};

#ifdef PROBEGI_TEST_VULKAN
/// The Vulkan backend with one of its tracers.
template <TracerKind kind>
BackendMaker vulkanBackend(const char* name, bool (*possible)()) {
    return {name, [](const Context& context) { return vulkan::makeBackend(context, testDevice(), kind); },
            [](const HdrImage& image, const ToneMap& toneMap) {
                return vulkan::toneMapImage(testDevice(), image, toneMap);
            },
            possible};
}
#endif

inline std::span<const BackendMaker> backendMakers() {
    static const BackendMaker all[] = {
        kCpu,
#ifdef PROBEGI_TEST_VULKAN
        vulkanBackend<TracerKind::bvh>("vulkanBvh", [] { return true; }),
        vulkanBackend<TracerKind::rayQuery>("vulkanRayQuery", [] { return testDevice().rayQuery(); }),
#endif
    };
    return all;
}

}  // namespace probegi::test
