#include "field/volume_access.h"

#include <algorithm>
#include <numeric>

namespace probegi {

std::vector<int> volumesByDensity(const FieldDesc& desc) {
    std::vector<int> order(desc.volumes.size());
    std::iota(order.begin(), order.end(), 0);
    const auto cell = [&](int volume) {
        const glm::vec3& spacing = desc.volumes[std::size_t(volume)].spacing;
        return double(spacing.x) * double(spacing.y) * double(spacing.z);
    };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return cell(a) < cell(b); });
    return order;
}

VolumeOrder volumeOrder(const FieldDesc& desc, const FieldSettings& settings, std::span<const int> byDensity) noexcept {
    VolumeOrder order{.byDensity = byDensity,
                      .outsideFades = settings.outside == OutsideLight::fades,
                      .outsideRadiance = settings.outsideRadiance};
    if (!settings.camera) return order;
    order.camera = *settings.camera;
    for (std::size_t i = 0; i < desc.volumes.size(); ++i)
        if (desc.volumes[i].tracksCamera) order.tracking |= 1u << i;
    return order;
}

std::vector<float> sharesOfVolumes(const VolumeAccess& access, glm::vec3 point) {
    const int count = volumeCount(access);
    std::vector<float> shares(std::size_t(count), 0.0f);
    const kernels::VolumeAnswer known{glm::vec3(0.0f), 1.0f};
    kernels::VolumeBlend blend = kernels::emptyBlend();
    int nearest = 0;
    for (int rank = 0; rank < count; ++rank) {
        const kernels::Volume& v = volumeOfRank(access, rank);
        const float weight = kernels::nextWeight(blend, kernels::cellsInRank(access, rank, v, point));
        if (weight > 0.0f) blend = kernels::withVolume(blend, known, weight);
        shares[std::size_t(access.volumeAt(rank))] = weight;
        const float distance = kernels::squareDistanceToVolume(v, point);
        if (!kernels::isNearer(blend, distance)) continue;
        blend.distance = distance;
        nearest = access.volumeAt(rank);
    }
    if (!(blend.total > 0.0f)) shares[std::size_t(nearest)] = blend.total = 1.0f;
    for (float& share : shares) share /= blend.total;
    return shares;
}

}  // namespace probegi
