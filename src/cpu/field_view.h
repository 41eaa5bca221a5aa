#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "cpu/field_storage.h"
#include "field/volume_access.h"
#include "kernels/sdf/sdf_solid.h"
#include "kernels/volume/volume.h"

namespace probegi {

/// The four texels of a bilinear footprint in an octahedral map, border resolved.
using TapTable = std::vector<std::array<std::uint16_t, 4>>;

/// Footprints whose top left texel is (x, y), -1 <= x, y < size, at index (y + 1) * (size + 1) + (x + 1).
TapTable makeTapTable(int size);

/// What a query reads: a view of a field on which nothing is checked.
struct FieldView {
    std::span<const kernels::Volume> volumes;
    VolumeOrder order{};
    int slots = 0;  ///< of all volumes
    int irradianceTexels = 8;
    int visibilityTexels = 16;
    float selfShadowBias = 0.3f;
    LeakGuard guard = LeakGuard::moments;
    FieldRules rules = FieldRules::measured;
    const std::uint16_t* irradiance = nullptr;
    const std::uint32_t* visibility = nullptr;
    const float* backfaceShare = nullptr;
    const std::uint32_t* placements = nullptr;  ///< kernels/volume/probe_offset.h
    const std::uint32_t* maskWords = nullptr;   ///< with LeakGuard::masks: kernels/guards/masks.h
    int maskTexels = 2;                         ///< along a cell's edge
    bool maskPacked = false;
    std::span<const kernels::SdfBlocker> blockers{};  ///< with LeakGuard::sdfShadow
    std::atomic<std::uint64_t>* fallbacks = nullptr;  ///< counts the queries whose cage had too little weight
    const TapTable* irradianceTaps = nullptr;
    const TapTable* visibilityTaps = nullptr;
};

/// E in W m^-2 at each query (section 2.2), on the calling thread; of several volumes as kernels::blendedIrradiance()
/// has it.
void queryIrradiance(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out);

/// Mean and mean square of distance / maxDistance that the probe of a slot stores in a direction of the world.
glm::vec2 probeMoments(const FieldView& view, int slot, glm::vec3 direction);

}  // namespace probegi
