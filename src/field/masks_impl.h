#pragma once

#include "probegi/masks.h"

namespace probegi {

struct Masks::Impl {
    std::vector<VolumeDesc> volumes;
    int clusters = 0;
    int factor = 0;
    std::vector<std::uint32_t> words;
    MaskReport report;
};

}  // namespace probegi
