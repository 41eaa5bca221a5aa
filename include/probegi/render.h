#pragma once

#include <optional>

#include "probegi/export.h"
#include "probegi/field.h"
#include "probegi/image.h"
#include "probegi/tracer.h"

namespace probegi {

/// A picture and the layers it is made of, all in linear units and of the same size.
/// color = emission + direct + indirect at every pixel that shows a surface, the sky elsewhere.
struct Picture {
    HdrImage color;       ///< radiance, W sr^-1 m^-2
    HdrImage direct;      ///< radiance from punctual lights and the sun, and the surface's own emission
    HdrImage indirect;    ///< radiance from everything else (surfaces, emissive ones and sky included)
    HdrImage irradiance;  ///< E behind `indirect`, W m^-2; 0 where the sky is seen
    HdrImage albedo;      ///< base colour
    HdrImage normal;      ///< world-space shading normal, components -1..1
    HdrImage depth;       ///< distance from the camera in metres, in all three channels; 0 where the sky is seen
};

struct PictureDesc {
    PlacedCamera camera;
    int width = 960;           ///< 1..16384
    int height = 540;          ///< 1..16384
    int samplesPerAxis = 2;    ///< supersampling of primary rays, 1..8; the layers are box-filtered
    bool diffuseOnly = false;  ///< all materials as Lambert of their base colour
};

/// Milliseconds of one picture.
struct PictureTimes {
    double primary = 0;
    double direct = 0;
    double query = 0;
    double total = 0;
};

struct RenderedPicture {
    Picture picture;
    PictureTimes times;
};

/// Ray-cast picture with shadows; `field` adds indirect light (null: none).
/// Errors: invalidArgument (size), cancelled, outOfMemory, and those of the tracer and of the field's irradiance().
PROBEGI_API Result<RenderedPicture> renderPicture(const Context& context, const Tracer& tracer,
                                                  const Lighting& lighting, const Field* field,
                                                  const PictureDesc& desc);

}  // namespace probegi
