#pragma once

#include <stdexcept>

#include "probegi/field.h"

namespace probegi::test {

/// One probe of a field; throws, which fails the test, where it cannot be read.
inline FieldSnapshot readProbe(const Field& field, int slot) {
    auto snapshot = field.read({slot, 1});
    if (!snapshot) throw std::runtime_error(snapshot.error().message);
    return std::move(*snapshot);
}

inline glm::vec3 probeIrradiance(const Field& field, int slot, glm::vec3 normal) {
    return readProbe(field, slot).probeIrradiance(slot, normal);
}
inline glm::vec2 probeDistanceMoments(const Field& field, int slot, glm::vec3 direction) {
    return readProbe(field, slot).probeDistanceMoments(slot, direction);
}
inline float probeBackfaceShare(const Field& field, int slot) {
    return readProbe(field, slot).state(slot).backfaceShare;
}

}  // namespace probegi::test
