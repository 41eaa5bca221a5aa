#pragma once

#include <span>

#include "field/probe_trace.h"
#include "kernels/light/emitter_sampling.h"
#include "probegi/field.h"

namespace probegi {

/// Parameters of an update's emitter sampling.
struct EmitterSearch {
    const EmitterSet* set = nullptr;  ///< null: none
    int rays = 0;                     ///< update rays a probe
    int looks = 0;                    ///< per probe
    std::uint32_t seed = 0;           ///< differs between frames

    explicit operator bool() const noexcept { return set != nullptr; }
    /// Weight of an emission for the update ray that hit it; emitter samples contribute the rest.
    float rayShare(std::int32_t material, float distance) const noexcept {
        return set ? kernels::rayEmissionShare(rays, looks, set->density(material), distance) : 1.0f;
    }
};

/// Emitter samples per probe: FieldDesc::emitterSamples, or none if the rules say so.
inline int emitterLooks(const FieldDesc& desc) noexcept {
    return desc.rules == FieldRules::paper ? 0 : desc.emitterSamples;
}

/// The search of an update; empty if the tracer has no emitters. `frameSeed`: UpdateFrame::ditherSeed.
EmitterSearch emitterSearch(const FieldDesc& desc, const Tracer& tracer, std::uint32_t frameSeed);

/// Emitter samples of the tasks' probes, as [task][look], on the context's threads. The search must not be
/// empty. Errors: those of the tracer.
Result<void> lookAtEmitters(const Context& context, std::span<const kernels::Volume> volumes,
                            std::span<const ProbeTask> tasks, const EmitterSearch& search, const Tracer& tracer,
                            std::span<kernels::EmitterLight> out, TraceTimes& times);

}  // namespace probegi
