#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/language.h"

namespace probegi::kernels {

/// One result of a lane, and how closely the GPU must agree.
struct Expected {
    std::uint32_t bits = 0;
    float tolerance = 0;
    bool exact = false;  ///< an integer: bit for bit
};

/// The C++ side of shaders/lane.h: reads the same inputs and keeps the results expected from the GPU.
struct Lane {
    std::span<const std::uint32_t> inputs;
    std::vector<Expected> outputs = {};
    std::size_t nextInput = 0;
    bool ranOut = false;  ///< whether it took more inputs than there are
};

inline uint takeBits(Lane& lane) {
    if (lane.nextInput >= lane.inputs.size()) {
        lane.ranOut = true;
        return 0;
    }
    return lane.inputs[lane.nextInput++];
}

inline void giveBits(Lane& lane, uint value) {
    lane.outputs.push_back({.bits = value, .exact = true});
}

inline void give(Lane& lane, float value, float tolerance) {
    lane.outputs.push_back({.bits = floatBitsToUint(value), .tolerance = tolerance});
}

}  // namespace probegi::kernels

#include "kernels_gpu/shaders/lane.h"
