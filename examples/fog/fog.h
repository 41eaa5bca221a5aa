#pragma once

#include <probegi/probegi.h>

/// A homogeneous medium in a box that scatters light in all directions alike, once (single scattering).
struct Fog {
    probegi::Bounds where;
    float extinction = 0.2f;  ///< per metre
    float albedo = 0.95f;     ///< share of the extinguished light that is scattered
};

/// Mean radiance that arrives from all sides at points in the air, W sr^-1 m^-2: of the field, without the direct light
/// of punctual lights.
std::vector<glm::vec3> meanRadiance(const probegi::Field& field, std::span<const glm::vec3> points);

/// Adds the fog to a picture: what lies behind it is dimmed, and it scatters the field's light and the sun's, with
/// shadow rays. Throws probegi::BadResult.
void addFog(const Fog& fog, const probegi::Field& field, const probegi::Tracer& tracer,
            const probegi::Lighting& lighting, const probegi::PlacedCamera& camera, probegi::Picture& picture);
