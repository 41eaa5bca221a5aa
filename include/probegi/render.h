#pragma once

#include <optional>

#include "probegi/export.h"
#include "probegi/field.h"
#include "probegi/image.h"
#include "probegi/tracer.h"

namespace probegi {

/// A picture and its layers, all linear and of the same size.
/// color = emission + direct + indirect where a surface is visible, the sky elsewhere.
struct Picture {
    HdrImage color;       ///< radiance, W sr^-1 m^-2
    HdrImage direct;      ///< radiance from punctual lights and the sun, plus the surface's own emission
    HdrImage indirect;    ///< radiance from everything else, emissive surfaces and sky included
    HdrImage irradiance;  ///< E behind `indirect`, W m^-2; 0 where the sky is visible
    HdrImage albedo;      ///< base colour
    HdrImage normal;      ///< world-space shading normal, components -1..1
    HdrImage depth;       ///< distance from the camera in metres, in all three channels; 0 where the sky is visible
};

struct PictureDesc {
    PlacedCamera camera;
    int width = 960;           ///< 1..16384
    int height = 540;          ///< 1..16384
    int samplesPerAxis = 2;    ///< supersampling of primary rays, 1..8; the layers are box-filtered
    bool diffuseOnly = false;  ///< render all materials as Lambert with their base colour
};

/// Timings of one picture, milliseconds.
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
/// Errors: invalidArgument (size), cancelled, outOfMemory, and those of the tracer and of Field::irradiance().
PROBEGI_API Result<RenderedPicture> renderPicture(const Context& context, const Tracer& tracer,
                                                  const Lighting& lighting, const Field* field,
                                                  const PictureDesc& desc);

}  // namespace probegi
