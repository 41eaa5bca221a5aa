#pragma once

#include "probegi/field.h"
#include "probegi/render.h"

namespace probegi {

/// PictureDesc::contactReach in metres: by the spacing of the finest of the field's volumes that holds the camera, or
/// of the finest of all; without a field (null) by the scene's bounds.
float contactReach(const PictureDesc& desc, const Field* field, const Bounds& scene);

}  // namespace probegi
