#pragma once

#include <atomic>
#include <cstdint>

#include "kernels/screen/pinhole.h"
#include "probegi/render.h"
#include "render/tile_samples.h"

namespace probegi {

/// Renders any tile of one picture. Thread-safe if each thread has its own TileSamples and tiles.
class TileRenderer {
public:
    TileRenderer(const Tracer& tracer, const Lighting& lighting, const Field* field, const PictureDesc& desc);

    /// Errors: those of the tracer and of Field::irradiance.
    Result<void> render(const Tile& tile, TileSamples& samples, Picture& picture);

    /// Time of each stage, summed over threads.
    PictureTimes threadTimes() const;

private:
    /// Cone angle of a primary ray, radians.
    float spread() const;
    Result<void> castPrimary(const Tile& tile, TileSamples& samples) const;
    Result<void> queryField(TileSamples& samples) const;
    void resolve(const Tile& tile, const TileSamples& samples, Picture& picture) const;

    const Tracer& m_tracer;
    const Lighting& m_lighting;
    const Field* m_field;
    PictureDesc m_desc;
    kernels::PinholeCamera m_camera;
    float m_sceneMagnitude;
    std::atomic<std::int64_t> m_primaryNs{0}, m_directNs{0}, m_queryNs{0};
};

}  // namespace probegi
