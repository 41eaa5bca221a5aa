#pragma once

#include "cpu/footprint.h"
#include "field/guard_number.h"
#include "kernels/lookup/access.h"
#include "kernels/probe/storage.h"

namespace probegi {

/// How the look-up's kernels (kernels/lookup/access.h) read a field one point at a time.
class FieldAccess {
public:
    using MapPoint = Footprint;
    int rules;
    int guard;
    float selfShadowBias;
    int maskTexels, maskPacked;
    int blockers;

    explicit FieldAccess(const FieldView& view)
        : rules(view.rules == FieldRules::paper ? kernels::kRulesPaper : kernels::kRulesMeasured),
          guard(guardNumber(view.guard)),
          selfShadowBias(view.selfShadowBias),
          maskTexels(view.maskTexels),
          maskPacked(view.maskPacked ? 1 : 0),
          blockers(int(view.blockers.size())),
          m_view(view) {}

    friend float storedBackfaceShare(const FieldAccess& a, int slot) { return a.m_view.backfaceShare[slot]; }
    friend int storedPlacement(const FieldAccess& a, int slot) { return int(a.m_view.placements[slot]); }
    friend float givenVisibility(const FieldAccess&, int) { return 1.0f; }
    friend int maskWord(const FieldAccess& a, int number) { return int(a.m_view.maskWords[number]); }
    friend const kernels::SdfBlocker& blockerAt(const FieldAccess& a, int number) {
        return a.m_view.blockers[std::size_t(number)];
    }
    friend void countFallback(const FieldAccess& a) {
        if (a.m_view.fallbacks) a.m_view.fallbacks->fetch_add(1, std::memory_order_relaxed);
    }

    friend Footprint visibilityPoint(const FieldAccess& a, glm::vec3 direction) {
        return footprintOf(*a.m_view.visibilityTaps, a.m_view.visibilityTexels, direction);
    }
    friend Footprint axisPoint(const FieldAccess& a, const kernels::Volume& v, int axis, bool up) {
        return visibilityPoint(a, kernels::axisDirection(v, axis, up));
    }
    friend Footprint irradiancePoint(const FieldAccess& a, glm::vec3 normal) {
        return footprintOf(*a.m_view.irradianceTaps, a.m_view.irradianceTexels, normal);
    }

    friend void storedMoments(const FieldAccess& a, int slot, const Footprint& at, float& mean, float& meanSquare) {
        const glm::vec2 moments = momentsAt(a.m_view, slot, at);
        mean = moments.x;
        meanSquare = moments.y;
    }
    friend void momentsOnAxis(const FieldAccess& a, const kernels::Volume&, int slot, const Footprint& at, float& mean,
                              float& meanSquare) {
        storedMoments(a, slot, at, mean, meanSquare);
    }
    friend glm::vec3 storedIrradiance(const FieldAccess& a, int slot, const Footprint& at) {
        const std::size_t texels = std::size_t(a.m_view.irradianceTexels) * std::size_t(a.m_view.irradianceTexels);
        const std::uint16_t* map = a.m_view.irradiance + 3 * texels * std::size_t(slot);
        glm::vec3 stored(0.0f);
        for (std::size_t tap = 0; tap < 4; ++tap) {
            const std::uint16_t* texel = map + 3 * at.offset[tap];
            stored += at.weight[tap] * glm::vec3(kernels::unpackHalf(texel[0]), kernels::unpackHalf(texel[1]),
                                                 kernels::unpackHalf(texel[2]));
        }
        return stored;
    }

private:
    const FieldView& m_view;
};

}  // namespace probegi
