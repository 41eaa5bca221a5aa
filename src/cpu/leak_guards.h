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
///     Real between(const FieldView&, const FourProbes&, const AxisTexels&, float distance) const
/// how far each of four probes (lanes 0 to 3; the others mean nothing) sees another one that stands `distance` metres
/// away along an axis, around which the four texels of the visibility maps lie. It is a template argument of the query,
/// so that a guard costs what it does and nothing more.
using FourProbes = std::array<std::int32_t, 4>;  ///< linear indices

struct CageQuery {
    std::array<std::int32_t, kernels::wide::kLanes> probes;  ///< linear indices
    kernels::wide::Real3 biasedPointFromProbe;  ///< from each probe to the point with the self-shadow bias, metres
};

/// The leaking baseline: every probe is as good as its place.
struct NoGuard {
    kernels::wide::Real operator()(const FieldView&, const CageQuery&) const { return 1.0f; }
    kernels::wide::Real between(const FieldView&, const FourProbes&, const AxisTexels&, float) const { return 1.0f; }
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

    kernels::wide::Real between(const FieldView& view, const FourProbes& probes, const AxisTexels& texels,
                                float distance) const {
        using namespace kernels::wide;
        using Four = stdx::fixed_size_simd<float, 4>;
        using FourInts = stdx::fixed_size_simd<std::int32_t, 4>;
        const std::int32_t texelsPerProbe = view.desc->visibilityTexels * view.desc->visibilityTexels;
        // Four equal weights: sums of integers will do.
        FourInts mean = 0, meanSquare = 0;
        for (const std::uint32_t texel : texels) {
            alignas(16) std::array<std::uint32_t, 4> packed;
            for (std::size_t i = 0; i < 4; ++i)
                packed[i] = view.visibility[std::size_t(probes[i] * texelsPerProbe) + texel];
            const stdx::fixed_size_simd<std::uint32_t, 4> bits(packed.data(), stdx::vector_aligned);
            mean += stdx::static_simd_cast<FourInts>(bits & 0xffffu);
            meanSquare += stdx::static_simd_cast<FourInts>(bits >> 16);
        }
        const auto lanes = [](const FourInts& sum) {
            alignas(32) std::array<float, kLanes> values{};
            (stdx::static_simd_cast<Four>(sum) * (0.25f / 65535.0f)).copy_to(values.data(), stdx::element_aligned);
            return Real(values.data(), stdx::element_aligned);
        };
        return chebyshevWeight(lanes(mean), lanes(meanSquare), distance * view.inverseMaxDistance, rules);
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
