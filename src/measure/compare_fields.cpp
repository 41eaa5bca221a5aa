#include <array>
#include <cmath>
#include <new>
#include <numbers>

#include "core/sentence.h"
#include "field/layout.h"
#include "field/snapshot.h"
#include "kernels/lookup/probe_query.h"
#include "kernels/probe/probe_state.h"
#include "probegi/measure.h"

namespace probegi {

namespace {

constexpr int kDirections = 32;
constexpr double kDark = 0.01;  // of the mean light: ratios below mean nothing

using Directions = std::array<glm::vec3, kDirections>;

Directions evenDirections() {
    Directions directions;
    for (int i = 0; i < kDirections; ++i) {
        const double z = 1 - (2.0 * i + 1) / kDirections, radius = std::sqrt(1 - z * z);
        const double angle = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
        directions[std::size_t(i)] = glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return directions;
}

bool isUsed(const ProbeState& state) {
    return state.backfaceShare <= kernels::kInsideShare && !kernels::isUnused(state.placement & 0xffu);
}

bool isWhole(const FieldSnapshot& snapshot) {
    return snapshot.slots == SlotRange{0, probeCount(snapshot.desc)};
}

Result<void> checkAlone(const FieldSnapshot& snapshot) {
    return validateFieldDesc(snapshot.desc).and_then([&] { return validateSnapshot(snapshot.desc, snapshot); });
}

Result<void> checkAlike(const FieldSnapshot& a, const FieldSnapshot& b) {
    if (!isWhole(a) || !isWhole(b))
        return fail(ErrorCode::invalidArgument, "a field that is compared lacks some of its probes");
    if (a.desc.volumes != b.desc.volumes || a.scrolled != b.scrolled)
        return fail(ErrorCode::invalidArgument,
                    "the fields have probes at other places; compare fields with the same volumes");
    if (a.desc.irradianceTexels == b.desc.irradianceTexels && a.desc.visibilityTexels == b.desc.visibilityTexels)
        return checkAlone(a).and_then([&] { return checkAlone(b); });
    return fail(ErrorCode::invalidArgument,
                sentence("one field has maps of ", a.desc.irradianceTexels, " and ", a.desc.visibilityTexels,
                         " texels, the other of ", b.desc.irradianceTexels, " and ", b.desc.visibilityTexels));
}

/// Light of one probe in both fields, and how it differs by direction.
struct Pair {
    int slot;
    double a, b;    ///< mean over directions and channels of E, W m^-2
    double square;  ///< mean squared difference
};

Pair pairOf(const FieldSnapshot& a, const FieldSnapshot& b, int slot, const Directions& directions) {
    Pair pair{slot, 0, 0, 0};
    for (const glm::vec3& direction : directions) {
        const glm::dvec3 x = a.probeIrradiance(slot, direction), y = b.probeIrradiance(slot, direction);
        for (int c = 0; c < 3; ++c) {
            pair.a += x[c];
            pair.b += y[c];
            pair.square += (x[c] - y[c]) * (x[c] - y[c]);
        }
    }
    constexpr double kShare = 1.0 / (3 * kDirections);
    return {slot, pair.a * kShare, pair.b * kShare, pair.square * kShare};
}

}  // namespace

Result<FieldDifference> compareFields(const FieldSnapshot& a, const FieldSnapshot& b) try {
    if (auto ok = checkAlike(a, b); !ok) return ok.error();
    const Directions directions = evenDirections();
    std::vector<Pair> pairs;
    double sumA = 0, sumB = 0, square = 0;
    for (int slot = 0; slot < a.slots.count; ++slot) {
        if (!isUsed(a.state(slot)) || !isUsed(b.state(slot))) continue;
        pairs.push_back(pairOf(a, b, slot, directions));
        sumA += pairs.back().a;
        sumB += pairs.back().b;
        square += pairs.back().square;
    }
    FieldDifference difference;
    difference.probes = int(pairs.size());
    difference.equalMaps = a.irradiance == b.irradiance && a.visibility == b.visibility;
    difference.equalStates = difference.equalMaps && a.states == b.states;
    if (!(sumB > 0)) return difference;
    const double count = double(pairs.size()), mean = sumB / count;
    difference.mean = sumA / sumB;
    difference.rms = std::sqrt(square / count) / mean;
    std::vector<double> ratios;
    for (const Pair& pair : pairs) {
        if (pair.b < kDark * mean) continue;
        ratios.push_back(pair.a / pair.b);
        const double off = std::abs(pair.a - pair.b) / pair.b;
        if (difference.worstSlot >= 0 && off <= difference.worst) continue;
        difference.worst = off;
        difference.worstSlot = pair.slot;
    }
    difference.ratio = percentiles(std::move(ratios));
    return difference;
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory to compare fields");
}

}  // namespace probegi
