#pragma once

#include <cstdint>
#include <memory>
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
    /// Radiance of the glossy lobes, a part of `indirect`. Empty (0 x 0) but with PictureDesc::glossy.
    HdrImage glossy{};
    /// E that nearby surfaces on the screen send, unblurred unlike `irradiance`. Empty but with PictureDesc::contact.
    HdrImage contact{};
    /// Share of E's directions that is open, 1 - what `contact` is from, in all three channels; 0 where the sky is
    /// visible. Empty but with PictureDesc::contact.
    HdrImage openness{};
};

/// Reflections of more than punctual lights (DDGI paper, section 4.4).
enum class Glossy : std::uint8_t {
    off,    ///< none: indirect light is reflected as by Lambert surfaces of the base colour, metals too
    first,  ///< rays at half the resolution; of what they hit, the emission and the diffuse light
    field,  ///< and its own glossy light, from the field: second and later reflections, at maximum roughness
};

/// What contact light remembers of the pictures so far, so that the next one has less noise. Of one series of pictures
/// on one renderer; move-only.
class PROBEGI_API ContactHistory {
public:
    ContactHistory();
    ContactHistory(ContactHistory&&) noexcept;
    ContactHistory& operator=(ContactHistory&&) noexcept;
    ~ContactHistory();

    /// The next picture begins anew: the camera was cut.
    void forget() noexcept;

    struct Impl;
    Impl& impl() noexcept { return *m_impl; }

private:
    std::unique_ptr<Impl> m_impl;
};

struct PictureDesc {
    PlacedCamera camera;
    int width = 960;           ///< 1..16384
    int height = 540;          ///< 1..16384
    int samplesPerAxis = 2;    ///< supersampling of primary rays, 1..8; the layers are box-filtered
    bool diffuseOnly = false;  ///< render all materials as Lambert with their base colour
    /// Beyond a roughness of 0.75 (fading from 0.6 on) all of it is from the field, without a ray; nothing without one.
    /// Ignored with diffuseOnly, and by the path tracer, which has all light.
    Glossy glossy = Glossy::off;
    /// Contact GI (SDFDDGI paper, section 3.5): light and shadow of surfaces nearby, which are too small or too near
    /// for the probes, from the picture's own samples. Ignored by the path tracer, which has all light.
    bool contact = false;
    /// How far it looks, as a share of the distance between probes (without a field: of an eighth of the scene's
    /// diagonal), > 0, at most 4. Farther surfaces are the probes' own.
    float contactReach = 1.0f;
    /// With `contact`: this picture goes on from the one before; null: it is by itself. Pictures of more than 2^23
    /// pixels are always by themselves. Must outlive the call.
    ContactHistory* contactHistory = nullptr;
};

/// Timings of one picture, milliseconds.
struct PictureTimes {
    double primary = 0;
    double direct = 0;
    double query = 0;
    double glossy = 0;   ///< all passes of PictureDesc::glossy
    double contact = 0;  ///< all passes of PictureDesc::contact
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
