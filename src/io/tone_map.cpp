#include "kernels/screen/tone_map.h"

#include "probegi/image.h"

namespace probegi {

glm::vec3 toDisplay(glm::vec3 linear, const ToneMap& toneMap) {
    return kernels::toneMap(linear, toneMap.exposure, toneMap.filmic);
}

}  // namespace probegi
