#pragma once

#include <cmath>
#include <cstdint>

#include "cpu/footprint.h"
#include "cpu/probe_query.h"
#include "cpu/wide.h"

namespace probegi {

/// A leak guard is a type with two functions:
///     Real operator()(const FieldView&, const CageQuery&) const
/// says for each of the eight probes of the cage, 0..1, how far the point may use it, and
///     float between(const FieldView&, int probe, const Footprint&, float distance) const
/// how far a probe sees another one that stands `distance` metres away, in the direction of a footprint of the
/// visibility maps. It is a template argument of the query, so that a guard costs what it does and nothing more.
struct CageQuery {
    std::array<std::int32_t, kernels::wide::kLanes> probes;  ///< linear indices
    kernels::wide::Real3 biasedPointFromProbe;  ///< from each probe to the point with the self-shadow bias, metres
};

/// The leaking baseline: every probe is as good as its place.
struct NoGuard {
    kernels::wide::Real operator()(const FieldView&, const CageQuery&) const { return 1.0f; }
    float between(const FieldView&, int, const Footprint&, float) const { return 1.0f; }
};

/// Chebyshev test on the probes' distance moments (sections 2.2 and 4.1), by one of kernels::kRules.
template <int rules>
struct MomentsGuard {
    kernels::wide::Real operator()(const FieldView& view, const CageQuery& cage) const {
        using namespace kernels::wide;
        using Int = stdx::fixed_size_simd<std::int32_t, kLanes>;
        const Real3& d = cage.biasedPointFromProbe;
        const int size = view.desc->visibilityTexels;
        const Real2 texel = octTexelPosition(octEncode(d), size);
        const Real floorX = stdx::floor(texel.x), floorY = stdx::floor(texel.y);
        const Real fx = texel.x - floorX, fy = texel.y - floorY;
        // Rounding may put a direction a hair outside the square: the footprint stays inside the table.
        const Int footprint = stdx::static_simd_cast<Int>(
            (stdx::clamp(floorY, Real(-1.0f), Real(float(size - 1))) + 1.0f) * float(size + 1) +
            (stdx::clamp(floorX, Real(-1.0f), Real(float(size - 1))) + 1.0f));

        const std::int32_t texelsPerProbe = size * size;
        std::array<std::int32_t, kLanes> footprints;
        footprint.copy_to(footprints.data(), stdx::element_aligned);
        alignas(64) std::array<std::array<std::uint32_t, kLanes>, 4> taps;
        for (int lane = 0; lane < kLanes; ++lane) {
            const auto& table = (*view.visibilityTaps)[std::size_t(footprints[lane])];
            const std::uint32_t* map = view.visibility + std::size_t(cage.probes[lane]) * texelsPerProbe;
            for (int tap = 0; tap < 4; ++tap) taps[tap][lane] = map[table[tap]];
        }
        const auto mean = [&](int tap) { return lowHalf(taps[tap]); };
        const auto meanSquare = [&](int tap) { return highHalf(taps[tap]); };
        const auto bilinear = [&](const auto& value) -> Real {
            const Real top = value(0) + fx * (value(1) - value(0));
            const Real bottom = value(2) + fx * (value(3) - value(2));
            return (top + fy * (bottom - top)) * (1.0f / 65535.0f);
        };
        const Real distance = sqrt(d.x * d.x + d.y * d.y + d.z * d.z) * view.inverseMaxDistance;
        return chebyshevWeight(bilinear(mean), bilinear(meanSquare), distance, rules);
    }

    float between(const FieldView& view, int probe, const Footprint& towards, float distance) const {
        const glm::vec2 moments = momentsAt(view, probe, towards);
        return kernels::chebyshevWeight(moments.x, moments.y, distance * view.inverseMaxDistance, rules);
    }

private:
    using Bits = std::array<std::uint32_t, kernels::wide::kLanes>;
    using UInt = kernels::wide::stdx::fixed_size_simd<std::uint32_t, kernels::wide::kLanes>;
    using Int32 = kernels::wide::stdx::fixed_size_simd<std::int32_t, kernels::wide::kLanes>;

    static kernels::wide::Real toReal(const UInt& v) {
        // By way of signed integers: the values are below 2^16 and this conversion is one instruction.
        using namespace kernels::wide;
        return stdx::static_simd_cast<Real>(stdx::static_simd_cast<Int32>(v));
    }
    static kernels::wide::Real lowHalf(const Bits& b) {
        return toReal(UInt(b.data(), kernels::wide::stdx::vector_aligned) & 0xffffu);
    }
    static kernels::wide::Real highHalf(const Bits& b) {
        return toReal(UInt(b.data(), kernels::wide::stdx::vector_aligned) >> 16);
    }
};

}  // namespace probegi
