#include "cpu/blend_pass.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/parallel.h"
#include "cpu/emitter_blend.h"
#include "cpu/matrix_product.h"
#include "kernels/blend/temporal_filter.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/probe_texel.h"

namespace probegi {

namespace {

// Probes per task: enough for the matrix product, few enough for the L2 cache.
constexpr std::size_t kBlock = 32;

// `weightsOf(n)` returns a function from a ray's direction to its weight for the texel in direction n. Returns each
// texel's sum of weights before normalisation.
template <class WeightsOf>
std::vector<float> fillWeights(const Context& context, int size, std::span<const glm::vec3> directions,
                               std::vector<float>& out, const WeightsOf& weightsOf) {
    const std::size_t texels = std::size_t(size) * size;
    out.resize(directions.size() * texels);
    std::vector<float> sums(texels);
    parallelFor(context, texels, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t texel = begin; texel < end; ++texel) {
            const glm::vec3 n = kernels::octTexelDirection(int(texel) % size, int(texel) / size, size);
            const auto weight = weightsOf(n);
            float sum = 0;
            for (std::size_t ray = 0; ray < directions.size(); ++ray)
                sum += out[ray * texels + texel] = weight(directions[ray]);
            sums[texel] = sum;
            const float scale = kernels::normalisingFactor(sum);
            for (std::size_t ray = 0; ray < directions.size(); ++ray) out[ray * texels + texel] *= scale;
        }
    });
    return sums;
}

// Sanitised ray data of one block, as the left sides of the two products.
struct BlockInput {
    std::vector<kernels::SidesSeen> seen;  // by each probe
    Matrix radiance;                       // 3 rows a probe: r, g, b
    Matrix distance;                       // 2 rows a probe: distance, distance squared, as fractions of the farthest
    Matrix valid;                          // 1 row a probe: 0 where a ray hit a backface (BackfaceRule::excluded only)
    bool weighted = false;
};

// `data`: [task][ray].
void gather(bool weighted, std::span<const kernels::Volume> volumes, std::span<const ProbeTask> tasks,
            std::span<const RayDatum> data, BlockInput& in) {
    const std::size_t rows = tasks.size(), rays = data.size() / rows;
    in.radiance.resize(3 * rows, rays);
    in.distance.resize(2 * rows, rays);
    in.weighted = weighted;
    if (in.weighted) in.valid.resize(rows, rays);
    in.seen.assign(rows, {});
    for (std::size_t p = 0; p < rows; ++p) {
        const RayDatum* row = data.data() + p * rays;
        const float maxDistance = volumes[tasks[p].volume].maxDistance;
        kernels::SidesSeen& seen = in.seen[p];
        for (std::size_t r = 0; r < rays; ++r) {
            const RayDatum& d = row[r];
            const float distance = kernels::safeDistance(d.distance);
            const glm::vec3 radiance = kernels::arrivingRadiance(distance, d.radiance);
            const bool backface = kernels::hitBackface(distance, d.radiance.x);
            seen.hits += distance < kernels::kMissDistance ? 1 : 0;
            seen.backs += kernels::hitBack(distance) ? 1 : 0;
            seen.solidBacks += backface ? 1 : 0;
            for (int c = 0; c < 3; ++c) in.radiance(3 * p + c, r) = radiance[c];
            const float fraction = kernels::visibilityDistance(backface ? distance : std::abs(distance), maxDistance);
            in.distance(2 * p, r) = fraction;
            in.distance(2 * p + 1, r) = fraction * fraction;
            if (in.weighted) in.valid(p, r) = backface ? 0.0f : 1.0f;
        }
    }
}

// BackfaceRule::excluded: renormalises over the weights of the rays that count, instead of all weights.
void divideByValidity(const Matrix& validity, Matrix& irradiance) {
    for (std::size_t row = 0; row < irradiance.rows; ++row)
        for (std::size_t texel = 0; texel < irradiance.columns; ++texel)
            irradiance(row, texel) = kernels::withoutBackfaces(irradiance(row, texel), validity(row / 3, texel));
}

// What a probe keeps. A new one keeps nothing: with windows its step says so.
FrameHysteresis keptBy(const BlendFrame& frame, std::size_t task, const kernels::PackedProbeFilter& filter) {
    if (!frame.steps.empty()) return frame.steps[task].hysteresis;
    return kernels::isNew(filter) ? FrameHysteresis{0.0f, 0.0f} : frame.hysteresis;
}

// A probe that is blended. Dither goes by its number in the volume: a volume's probes do not depend on others.
struct Probe {
    std::size_t task, slot, number;
    FrameHysteresis kept;
};

// One probe's new irradiance (rows r, g, b over the texels) joins the stored one.
void storeIrradiance(const FieldSettings& settings, const BlendFrame& frame, const Matrix& mean, std::size_t row,
                     const Probe& probe, std::size_t texels, std::uint16_t* map) {
    const kernels::BlendRule rule{probe.kept.irradiance, settings.significantChange, settings.newDistribution};
    const float* r = &mean(row, 0);
    const float* g = &mean(row + 1, 0);
    const float* b = &mean(row + 2, 0);
    for (std::size_t t = 0; t < texels; ++t) {
        std::uint16_t* stored = map + 3 * t;
        const glm::vec3 newMean(r[t], g[t], b[t]);
        const glm::vec3 old(kernels::unpackHalf(stored[0]), kernels::unpackHalf(stored[1]),
                            kernels::unpackHalf(stored[2]));
        const glm::uvec3 bits = kernels::blendIrradianceTexel(old, newMean, rule, frame.linear, frame.ditherSeed,
                                                              std::uint32_t(probe.number * texels + t));
        for (int c = 0; c < 3; ++c) stored[c] = std::uint16_t(bits[c]);
    }
}

// Difference between new and stored irradiance: kernels::relativeChange over the texels.
float changeOf(const Matrix& mean, std::size_t row, std::size_t texels, const std::uint16_t* map) {
    const float* r = &mean(row, 0);
    const float* g = &mean(row + 1, 0);
    const float* b = &mean(row + 2, 0);
    kernels::TexelChange change = kernels::noChange();
    for (std::size_t t = 0; t < texels; ++t) {
        const std::uint16_t* stored = map + 3 * t;
        const glm::vec3 old(kernels::unpackHalf(stored[0]), kernels::unpackHalf(stored[1]),
                            kernels::unpackHalf(stored[2]));
        kernels::addTexelChange(change, old, {r[t], g[t], b[t]});
    }
    return kernels::relativeChange(change, int(texels));
}

void storeVisibility(const BlendFrame& frame, const Matrix& mean, std::size_t row, const Probe& probe,
                     std::span<const float> evidence, std::uint32_t* map) {
    const std::size_t texels = evidence.size();
    const float* d = &mean(row, 0);
    const float* dd = &mean(row + 1, 0);
    for (std::size_t t = 0; t < texels; ++t)
        map[t] = kernels::blendVisibilityTexel(map[t], {d[t], dd[t]},
                                               kernels::keptMoments(probe.kept.visibility, evidence[t]),
                                               frame.ditherSeed, std::uint32_t(probe.number * texels + t));
}

void storeSides(float kept, const kernels::SidesSeen& seen, int rays, kernels::ProbeSides& sides,
                float& backfaceShare) {
    sides = kernels::rememberSides(sides, seen, rays, kept);
    backfaceShare = glm::mix(kernels::solidShare(sides, seen, rays), backfaceShare, kept);
}

}  // namespace

FieldStorage::FieldStorage(const FieldLayout& layout)
    : irradiance(layout.probes * layout.irradianceTexels * 3 + 1),
      visibility(layout.probes * layout.visibilityTexels),
      filters(layout.probes),
      backfaceShare(layout.probes),
      placements(layout.probes),
      sides(layout.probes) {}

void makeBlendWeights(const Context& context, const FieldDesc& desc, float exponent,
                      std::span<const glm::vec3> directions, BlendWeights& weights) {
    fillWeights(context, desc.irradianceTexels, directions, weights.irradiance,
                [](glm::vec3 n) { return [n](glm::vec3 w) { return kernels::irradianceWeight(n, w); }; });
    weights.evidence = fillWeights(context, desc.visibilityTexels, directions, weights.visibility, [&](glm::vec3 n) {
        float nearest = 0;
        for (const glm::vec3& w : directions) nearest = std::max(nearest, glm::dot(n, w));
        const float least = kernels::leastVisibilityCosine(nearest, exponent);
        return [=](glm::vec3 w) { return glm::dot(n, w) > least ? kernels::visibilityWeight(n, w, exponent) : 0.0f; };
    });
    for (float& e : weights.evidence)
        e = desc.rules == FieldRules::paper ? 1.0f : kernels::visibilityEvidence(e, exponent, int(directions.size()));
}

void blendProbes(const Context& context, const FieldDesc& desc, std::span<const kernels::Volume> volumes,
                 const FieldSettings& settings, const BlendWeights& weights, std::span<const RayDatum> rayData,
                 const BlendFrame& frame, FieldStorage& storage, std::span<const kernels::EmitterLight> emitters) {
    const FieldLayout layout(desc);
    const bool weighted = settings.backfaceRule == BackfaceRule::excluded;
    const EmitterBlend looks(desc.irradianceTexels, emitters, frame.tasks.size());
    parallelFor(context, frame.tasks.size(), kBlock, [&](std::size_t begin, std::size_t end) {
        thread_local BlockInput in;
        thread_local Matrix irradiance, visibility, validity;
        const std::span<const ProbeTask> tasks = frame.tasks.subspan(begin, end - begin);
        gather(weighted, volumes, tasks, rayData.subspan(begin * layout.rays, tasks.size() * layout.rays), in);
        multiply(in.radiance, weights.irradiance, irradiance);
        looks.addTo(irradiance, begin, end);
        multiply(in.distance, weights.visibility, visibility);
        if (in.weighted) {
            multiply(in.valid, weights.irradiance, validity);
            divideByValidity(validity, irradiance);
        }
        for (std::size_t row = 0; row < tasks.size(); ++row) {
            const std::size_t slot = tasks[row].slot;
            const Probe probe{begin + row, slot,
                              std::size_t(kernels::probeNumber(volumes[tasks[row].volume], int(slot))),
                              keptBy(frame, begin + row, storage.filters[slot])};
            std::uint16_t* map = storage.irradiance.data() + 3 * slot * layout.irradianceTexels;
            if (!frame.steps.empty())
                frame.steps[probe.task].change = changeOf(irradiance, 3 * row, layout.irradianceTexels, map);
            storeIrradiance(settings, frame, irradiance, 3 * row, probe, layout.irradianceTexels, map);
            storeSides(probe.kept.visibility, in.seen[row], int(layout.rays), storage.sides[slot],
                       storage.backfaceShare[slot]);
            storeVisibility(frame, visibility, 2 * row, probe, weights.evidence,
                            storage.visibility.data() + slot * layout.visibilityTexels);
        }
    });
}

}  // namespace probegi
