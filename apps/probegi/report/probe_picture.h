#pragma once

#include <array>
#include <span>

#include "report/render.h"

namespace probegi::tool {

/// What a probe is to a picture, by what it sees.
enum class ProbeState { open, besideWall, dark, inWall };
inline constexpr std::size_t kProbeStates = 4;

/// A probe in a wall sees backs in over 30 % of its hits and lights nothing; one beside a wall sees some; a dark one is
/// in the open and receives less than a ten-thousandth of the mean of all that receive light.
std::vector<ProbeState> probeStates(std::span<const ProbeSight> probes);

/// "in the open" and so on.
const char* nameOf(ProbeState state);
/// As CSS, the colour in which probes of the state are drawn.
const char* colourOf(ProbeState state);

/// The picture dimmed, with a ball for every probe, hidden by what stands before it; probes in walls shine through.
/// `picture` must have its depth. Values as writeImage takes them, for exposure 1.
HdrImage drawProbes(const Picture& picture, float exposure, const PlacedCamera& camera, const VolumeDesc& grid,
                    std::span<const ProbeState> states);

}  // namespace probegi::tool
