// The light that emitter samples add to a probe's texels, by the definition of kernels::EmitterLight.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/blend_pass.h"
#include "field/control_impl.h"
#include "field/layout.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/storage.h"
#include "kernels/random.h"
#include "kernels/trace/ray_set.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

// With no light from the rays, each texel is the sum of the samples times the clamped cosine.
TEST(EmitterBlend, isTheSumOverSamples) {
    FieldSetup desc;
    desc.volumes[0].counts = {3, 3, 5};
    desc.raysPerProbe = 16;
    const FieldLayout layout(desc);
    FieldStorage storage(layout);
    std::vector<glm::vec3> directions;
    for (std::uint32_t i = 0; i < 16; ++i) directions.push_back(kernels::sphericalFibonacci(i, 16));
    constexpr std::size_t kLooks = 3;
    std::uint32_t state = 5;
    const auto random = [&] { return kernels::nextRandom(state); };
    std::vector<kernels::EmitterLight> looks;
    for (std::size_t i = 0; i < kLooks * layout.probes; ++i) {
        const glm::vec3 d = glm::normalize(glm::vec3(random(), random(), random()) - 0.5f);
        looks.push_back({d, glm::vec3(random(), 2 * random(), i % 2 ? 0.0f : 4 * random())});
    }
    BlendWeights weights;
    const Context context = *Context::create({.threads = 2});
    makeBlendWeights(context, desc, desc.visibilityExponent, directions, weights);
    const FieldControl control = makeFieldControl(desc, desc);
    const std::vector<RayDatum> data(layout.probes * layout.rays, RayDatum{glm::vec3(0.0f), 1.0f});
    blendProbes(context, desc, makeVolumes(desc), desc, weights, data, {control.tasks(), {0, 0}, false, 3}, storage,
                looks);
    for (std::size_t probe = 0; probe < layout.probes; ++probe)
        for (int texel = 0; texel < 64; ++texel) {
            const glm::vec3 n = kernels::octTexelDirection(texel % 8, texel / 8, 8);
            glm::dvec3 sum(0.0);
            for (std::size_t k = 0; k < kLooks; ++k) {
                const kernels::EmitterLight& look = looks[probe * kLooks + k];
                sum += std::max(0.0, double(glm::dot(n, look.direction))) * glm::dvec3(look.light);
            }
            for (std::size_t c = 0; c < 3; ++c) {
                const auto bits = storage.irradiance[3 * (probe * 64 + std::size_t(texel)) + c];
                const double truth = std::pow(sum[int(c)], 0.2);
                EXPECT_NEAR(kernels::unpackHalf(bits), truth, truth / 1000 + 1e-4) << probe << ' ' << texel;
            }
        }
}

}  // namespace
}  // namespace probegi
