#pragma once

#include <span>
#include <vector>

#include "cpu/field_storage.h"
#include "field/hysteresis.h"
#include "kernels/light/emitter_sampling.h"

namespace probegi {

/// Weights of every ray of a frame for every texel of a probe. Since all probes share the frame's rays, the
/// blend of all probes is a product with these two matrices. Both are [ray][texel], and normalised over the rays.
struct BlendWeights {
    std::vector<float> irradiance;
    std::vector<float> visibility;
    std::vector<float> evidence;  ///< [visibility texel]: kernels::visibilityEvidence(); 1 with the paper's rules
};

/// Fills the weights for a frame's directions (eq. 1, and its power-cosine form for distances).
void makeBlendWeights(const Context& context, const FieldDesc& desc, float visibilityExponent,
                      std::span<const glm::vec3> directions, BlendWeights& weights);

/// One probe's part of a blend with windows.
struct ProbeStep {
    FrameHysteresis hysteresis;  ///< what its windows keep
    float lag = 0;               ///< of its irradiance, relative
    float change = 0;  ///< out: mean square difference between new and old texels over the square of the old mean
    float ownLag = 0;  ///< kernels::ownLag
};

/// How new values are blended with old ones.
struct BlendFrame {
    std::span<const ProbeTask> tasks;  ///< the probes, in the order of their ray data
    FrameHysteresis hysteresis{};
    bool linear = false;              ///< blendLinear instead of blendEncoded
    std::uint32_t ditherSeed = 0;     ///< differs between frames
    std::span<ProbeStep> steps = {};  ///< [task]: each with its own hysteresis; empty: all with `hysteresis`
};

/// Blends the tasks' ray data into the storage: weights x data, then encoding, hysteresis and storage.
/// rayData is [task][ray]. Values that are not finite count as 0 radiance and as the farthest distance.
/// `emitters`: what the probes' looks at emitters brought, [task][look], or nothing.
void blendProbes(const Context& context, const FieldDesc& desc, std::span<const kernels::Volume> volumes,
                 const FieldSettings& settings, const BlendWeights& weights, std::span<const RayDatum> rayData,
                 const BlendFrame& frame, FieldStorage& storage, std::span<const kernels::EmitterLight> emitters = {});

}  // namespace probegi
