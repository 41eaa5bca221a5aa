#pragma once

#include <array>
#include <span>

#include "report/render.h"

namespace probegi::tool {

/// How a picture shows a probe.
enum class ProbeState { open, besideWall, dark, inWall };
inline constexpr std::size_t kProbeStates = 4;

/// A probe is in a wall, and not used, if over 30 % of its hits are backs; beside a wall if over 2 % are; dark if it is
/// in the open but receives less than a ten-thousandth of the mean of all probes that receive light.
std::vector<ProbeState> probeStates(std::span<const ProbeSight> probes);

/// "in the open" and so on.
const char* nameOf(ProbeState state);
/// CSS colour in which probes of the state are drawn.
const char* colourOf(ProbeState state);

/// The picture dimmed, with a ball for each visible probe; probes in walls show through. `picture` must have its depth.
/// The values are for writeImage at exposure 1.
HdrImage drawProbes(const Picture& picture, float exposure, const PlacedCamera& camera, const VolumeDesc& grid,
                    std::span<const ProbeState> states);

}  // namespace probegi::tool
