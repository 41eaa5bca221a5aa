#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/lookup/volume_blend.h"
#include "probegi/control.h"

namespace probegi {

/// How a field's volumes answer together (section 7.4), besides where they stand.
struct VolumeOrder {
    std::span<const int> byDensity{};  ///< densest first; empty: as they are listed
    std::uint32_t tracking = 0;        ///< bit i: volume i answers around the camera
    glm::vec3 camera{0.0f};            ///< metres, in the world
    bool outsideFades = false;         ///< FieldSettings::outside
    glm::vec3 outsideRadiance{0.0f};   ///< W sr^-1 m^-2
};

/// A field's volumes, those with most probes a cubic metre first, of equals the first of the list.
std::vector<int> volumesByDensity(const FieldDesc& desc);

/// `byDensity`: volumesByDensity(), which must outlive the result.
VolumeOrder volumeOrder(const FieldDesc& desc, const FieldSettings& settings, std::span<const int> byDensity) noexcept;

/// What kernels/lookup/volume_blend.h asks of a field, but for its probes.
class VolumeAccess {
public:
    VolumeAccess(std::span<const kernels::Volume> volumes, const VolumeOrder& order)
        : m_volumes(volumes), m_order(order) {}

    /// Number in the field's list of the volume of a rank.
    int volumeAt(int rank) const { return m_order.byDensity.empty() ? rank : m_order.byDensity[std::size_t(rank)]; }

    friend int volumeCount(const VolumeAccess& a) { return int(a.m_volumes.size()); }
    friend const kernels::Volume& volumeOfRank(const VolumeAccess& a, int rank) {
        return a.m_volumes[std::size_t(a.volumeAt(rank))];
    }
    friend bool rankTracksCamera(const VolumeAccess& a, int rank) {
        return (a.m_order.tracking >> unsigned(a.volumeAt(rank)) & 1u) != 0;
    }
    friend glm::vec3 cameraPosition(const VolumeAccess& a) { return a.m_order.camera; }
    friend bool outsideFades(const VolumeAccess& a) { return a.m_order.outsideFades; }
    friend glm::vec3 outsideRadiance(const VolumeAccess& a) { return a.m_order.outsideRadiance; }

private:
    std::span<const kernels::Volume> m_volumes;
    VolumeOrder m_order;
};

/// FieldControl::volumeShares.
std::vector<float> sharesOfVolumes(const VolumeAccess& access, glm::vec3 point);

}  // namespace probegi
