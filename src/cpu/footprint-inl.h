// Bilinear footprints in the octahedral maps, for the instruction set at hand: see cpu/lanes-inl.h.
#if defined(PROBEGI_CPU_FOOTPRINT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PROBEGI_CPU_FOOTPRINT_INL_H
#undef PROBEGI_CPU_FOOTPRINT_INL_H
#else
#define PROBEGI_CPU_FOOTPRINT_INL_H
#endif

#include "cpu/field_view.h"
#include "cpu/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace probegi::HWY_NAMESPACE {

/// Four texels of a map and where between them several directions lie: top left, top right, bottom left, bottom right.
struct LaneFootprint {
    kernels::HWY_NAMESPACE::Int tap[4];
    kernels::HWY_NAMESPACE::Real fx, fy;
};

/// For directions of any non-zero length in maps of `size` x `size` texels.
HWY_INLINE LaneFootprint footprintOf(const TapTable& table, int size, const kernels::HWY_NAMESPACE::Real3& direction) {
    namespace lanes = kernels::HWY_NAMESPACE;
    using lanes::Int, lanes::Real, lanes::Real2;
    const Real2 texel = lanes::octTexelPosition(lanes::octEncode(direction), size);
    // Rounding may put a direction a hair outside the square: the footprint stays inside the table.
    const Real last = float(size - 1);
    const Real cornerX = lanes::min(lanes::max(lanes::floor(texel.x), -1.0f), last);
    const Real cornerY = lanes::min(lanes::max(lanes::floor(texel.y), -1.0f), last);
    const Int entry = lanes::toInt((cornerY + 1.0f) * float(size + 1) + (cornerX + 1.0f));
    // Four taps of 16 bits, in two words.
    const auto* words = reinterpret_cast<const std::int32_t*>(table.data());
    const Int top = lanes::gather(words, entry + entry);
    const Int bottom = lanes::gather(words + 1, entry + entry);
    return {{lanes::lowHalf(top), lanes::highHalf(top), lanes::lowHalf(bottom), lanes::highHalf(bottom)},
            texel.x - cornerX,
            texel.y - cornerY};
}

}  // namespace probegi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
