#pragma once

#include <vector>

#include "probegi/tracer.h"

namespace probegi {

/// A light before and after a change, by its place in the lists; -1: it was off.
struct LightPair {
    int before = -1;
    int after = -1;
};

/// The lights that are not the same in both lists, whatever their order. Of these, those of one type belong together as
/// they follow each other; what is left over went on or off.
std::vector<LightPair> changedLights(const std::vector<PlacedLight>& before, const std::vector<PlacedLight>& after);

/// How much of a light is another one, 0..1 (SceneEdit::size). `distance`: its mean distance to what it lights, metres.
float lightChange(const PlacedLight& before, const PlacedLight& after, float distance);

/// The same for the sky.
float skyChange(const Sky& before, const Sky& after);

}  // namespace probegi
