#pragma once

#include <cstdint>
#include <vector>

#include "probegi/field.h"
#include "probegi/tracer.h"

namespace probegi {

/// A rectangle of pixels that one thread works on.
struct Tile {
    int x = 0, y = 0;
    int width = 0, height = 0;
};

/// Data of a tile's primary rays, pixel by pixel, sample by sample. `seen` lists the samples that hit a surface; arrays
/// of light have one entry for each of those. Reused from tile to tile.
struct TileSamples {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
    std::vector<std::uint32_t> seen;

    std::vector<glm::vec3> direct;  // with the surface's own emission
    std::vector<FieldQuery> queries;
    std::vector<glm::vec3> irradiance;  // from the field

    // Scratch for direct light: one entry per shadow ray of the current light.
    struct Candidate {
        std::uint32_t entry;   // of `seen`
        glm::vec3 irradiance;  // at normal incidence
    };
    std::vector<Candidate> candidates;
    std::vector<Ray> shadowRays;
    std::vector<std::uint8_t> blocked;
};

}  // namespace probegi
