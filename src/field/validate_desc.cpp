#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "core/sentence.h"
#include "field/layout.h"
#include "kernels/abi/field_constants.h"
#include "kernels/trace/ray_offset.h"
#include "probegi/masks.h"

namespace probegi {

namespace {

Result<void> checkRange(const std::string& name, double value, double lowest, double highest) {
    if (value >= lowest && value <= highest) return {};
    return fail(ErrorCode::invalidArgument, sentence(name, " is ", value, "; it must be ", lowest, " to ", highest));
}

Result<void> checkMapSize(const char* name, int size, int highest) {
    if (size % 2 == 0) return checkRange(name, size, 4, highest);
    return fail(ErrorCode::invalidArgument, sentence(name, " is ", size, "; it must be even"));
}

Result<void> checkOutside(const FieldSettings& s) {
    constexpr double kBrightest = 1e20;
    for (int c = 0; c < 3; ++c) {
        if (s.camera && !std::isfinite((*s.camera)[c]))
            return fail(ErrorCode::invalidArgument, "the camera's position is not finite");
        if (auto ok = checkRange("outsideRadiance", s.outsideRadiance[c], 0, kBrightest); !ok) return ok;
    }
    return {};
}

Result<void> checkOrientation(const std::string& name, const glm::quat& q) {
    constexpr float kTolerance = 1e-5f;
    const float square = glm::dot(q, q);
    if (std::abs(square - 1.0f) <= kTolerance) return {};
    return fail(ErrorCode::invalidArgument, sentence(name, ".orientation is not a unit quaternion; normalise it"));
}

Result<void> checkVolume(const std::string& name, const VolumeDesc& volume) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(volume.origin[axis]))
            return fail(ErrorCode::invalidArgument, sentence(name, ".origin is not finite"));
        if (auto ok = checkRange(name + ".spacing", volume.spacing[axis], kSmallestSpacing, kLargestSpacing); !ok)
            return ok;
        if (auto ok = checkRange(name + ".counts", volume.counts[axis], 2, 1024); !ok) return ok;
    }
    if (volume.tracksCamera && std::min({volume.counts.x, volume.counts.y, volume.counts.z}) < kFewestTracking)
        return fail(ErrorCode::invalidArgument, sentence(name, ".tracksCamera needs at least ", kFewestTracking,
                                                         " probes per axis: with fewer it would nowhere answer alone"));
    return checkOrientation(name, volume.orientation).and_then([&] { return validateVolumePlace(name, volume); });
}

Result<void> checkVolumes(const std::vector<VolumeDesc>& volumes) {
    if (auto ok = checkRange("the number of volumes", double(volumes.size()), 1, kernels::kMostVolumes); !ok) return ok;
    double probes = 0;
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        if (auto ok = checkVolume(sentence("volumes[", i, "]"), volumes[i]); !ok) return ok;
        const glm::ivec3& counts = volumes[i].counts;
        probes += double(counts.x) * counts.y * counts.z;
    }
    return checkRange("the number of probes in all volumes", probes, 8, 1 << 24);
}

}  // namespace

// Rays leave a surface from a little beside it, as far as coordinates are rounded there; that must be little for the
// probes too, or their light is lost.
Result<void> validateVolumePlace(const std::string& name, const VolumeDesc& volume) {
    constexpr float kMostOfSpacing = 0.25f;
    glm::vec3 corner(0.0f);
    const int last = probeCount(volume) - 1, x = volume.counts.x - 1, y = volume.counts.x * (volume.counts.y - 1);
    for (const int probe : {0, x, y, x + y, last, last - x, last - y, last - x - y})
        corner = glm::max(corner, glm::abs(probePosition(volume, probe)));
    const float closest = std::min({volume.spacing.x, volume.spacing.y, volume.spacing.z});
    if (kernels::rayOffset(corner, 0.0f) <= kMostOfSpacing * closest) return {};
    return fail(ErrorCode::invalidArgument,
                sentence(name, " reaches ", std::max({corner.x, corner.y, corner.z}),
                         " m from the origin, where coordinates are too coarse for probes ", closest,
                         " m apart; move the scene to the origin, or increase the spacing"));
}

Result<void> validateFieldDesc(const FieldDesc& d) {
    return checkVolumes(d.volumes)
        .and_then([&] { return checkRange("raysPerProbe", d.raysPerProbe, 8, 4096); })
        .and_then([&] { return checkRange("fixedRays", d.fixedRays, 0, 256); })
        .and_then([&] { return checkMapSize("irradianceTexels", d.irradianceTexels, 32); })
        .and_then([&] { return checkMapSize("visibilityTexels", d.visibilityTexels, 64); })
        .and_then([&] { return checkRange("emitterSamples", d.emitterSamples, 0, 16); });
}

Result<void> validateFieldSettings(const FieldSettings& s) {
    return checkRange("hysteresis", s.hysteresis, 0, 0.999f)
        .and_then([&] { return checkRange("visibilityHysteresis", s.visibilityHysteresis, 0, 0.999f); })
        .and_then([&] { return checkRange("visibilityExponent", s.visibilityExponent, 1, 500); })
        .and_then([&] { return checkRange("selfShadowBias", s.selfShadowBias, 0, 2); })
        .and_then([&] { return checkRange("significantChange", s.significantChange, 0, 1); })
        .and_then([&] { return checkRange("newDistribution", s.newDistribution, 0, 1); })
        .and_then([&] { return checkOutside(s); });
}

Result<void> validateGuard(const FieldDesc& desc, const FieldSettings& s, std::span<const glm::ivec3> scrolled) {
    if (s.guard == LeakGuard::sdfShadow && !s.blockers)
        return fail(ErrorCode::invalidArgument, "LeakGuard::sdfShadow needs FieldSettings::blockers; place them first");
    if (s.guard != LeakGuard::masks) return {};
    if (!s.masks)
        return fail(ErrorCode::invalidArgument, "LeakGuard::masks needs FieldSettings::masks; bake them first");
    if (s.masks->volumes() != desc.volumes)
        return fail(ErrorCode::invalidArgument,
                    "the masks were baked for other volumes than the field's; bake them again");
    if (std::any_of(scrolled.begin(), scrolled.end(), [](glm::ivec3 cells) { return cells != glm::ivec3(0); }))
        return fail(ErrorCode::invalidArgument, "volumes with masks cannot scroll; choose another leak guard first");
    return {};
}

}  // namespace probegi
