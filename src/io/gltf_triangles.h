#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace probegi::io {

/// Triangle topologies (glTF 2.0, section 3.7.2.1).
enum class Topology : std::uint8_t { triangles, strip, fan };

/// Three corners per triangle, counter-clockwise from the front. Excess vertices at the end are dropped.
std::vector<std::uint32_t> toTriangles(std::vector<std::uint32_t> vertices, Topology topology);

/// Renumbers the corners so that only vertices in use remain, in their old order; returns their old numbers. `corners`
/// must be below `vertices`.
std::vector<std::uint32_t> compactVertices(std::vector<std::uint32_t>& corners, std::size_t vertices);

}  // namespace probegi::io
