#include "render/tile_renderer.h"

#include <chrono>
#include <numbers>

#include "geometry/lighting.h"
#include "render/direct_light.h"
#include "scene/sky_radiance.h"

namespace probegi {

namespace {

using Clock = std::chrono::steady_clock;

// Adds the time since `start` to a stage and restarts the timer.
void lap(Clock::time_point& start, std::atomic<std::int64_t>& stage) {
    const auto now = Clock::now();
    stage += std::chrono::duration_cast<std::chrono::nanoseconds>(now - start).count();
    start = now;
}

// Sum of a pixel's samples.
struct PixelSum {
    glm::vec3 sky{0.0f}, direct{0.0f}, indirect{0.0f}, irradiance{0.0f}, albedo{0.0f}, normal{0.0f};
    float depth = 0;

    void addSurface(const Surface& surface, float distance, glm::vec3 directLight, glm::vec3 e) {
        direct += directLight;
        indirect += surface.albedo * e * std::numbers::inv_pi_v<float>;
        irradiance += e;
        albedo += surface.albedo;
        normal += surface.shadingNormal;
        depth += distance;
    }

    void store(Picture& picture, std::size_t pixel, float weight) const {
        picture.direct.pixels[pixel] = weight * direct;
        picture.indirect.pixels[pixel] = weight * indirect;
        picture.color.pixels[pixel] = picture.direct.pixels[pixel] + picture.indirect.pixels[pixel] + weight * sky;
        picture.irradiance.pixels[pixel] = weight * irradiance;
        picture.albedo.pixels[pixel] = weight * albedo;
        picture.normal.pixels[pixel] = weight * normal;
        picture.depth.pixels[pixel] = glm::vec3(weight * depth);
    }
};

}  // namespace

TileRenderer::TileRenderer(const Tracer& tracer, const Lighting& lighting, const Field* field, const PictureDesc& desc)
    : m_tracer(tracer),
      m_lighting(lighting),
      m_field(field),
      m_desc(desc),
      m_camera(kernels::makePinhole(desc.camera.position, desc.camera.forward, desc.camera.up, desc.camera.yfov,
                                    desc.width, desc.height)),
      m_sceneMagnitude(sceneMagnitude(tracer.bounds())) {
    // Lets the tracer prepare for filtering here, on all threads. If it fails, so will the first tile.
    static_cast<void>(tracer.filteredSurfaces({}, {}, spread(), {}));
}

float TileRenderer::spread() const {
    return kernels::pinholeSpread(m_camera, m_desc.samplesPerAxis);
}

Result<void> TileRenderer::render(const Tile& tile, TileSamples& samples, Picture& picture) {
    auto start = Clock::now();
    if (auto cast = castPrimary(tile, samples); !cast) return cast;
    lap(start, m_primaryNs);
    if (auto shaded = shadeDirect(m_tracer, m_lighting, m_sceneMagnitude, m_desc.diffuseOnly, samples); !shaded)
        return shaded;
    lap(start, m_directNs);
    if (auto asked = queryField(samples); !asked) return asked;
    lap(start, m_queryNs);
    resolve(tile, samples, picture);
    return {};
}

Result<void> TileRenderer::castPrimary(const Tile& tile, TileSamples& samples) const {
    const int side = m_desc.samplesPerAxis;
    const float step = 1.0f / float(side);
    samples.rays.clear();
    for (int y = tile.y; y < tile.y + tile.height; ++y)
        for (int x = tile.x; x < tile.x + tile.width; ++x)
            for (int s = 0; s < side * side; ++s)
                samples.rays.push_back({m_camera.origin, 0.0f,
                                        kernels::pinholeDirection(m_camera, float(x) + (float(s % side) + 0.5f) * step,
                                                                  float(y) + (float(s / side) + 0.5f) * step)});
    samples.hits.resize(samples.rays.size());
    samples.surfaces.resize(samples.rays.size());
    if (auto hit = m_tracer.closestHits(samples.rays, samples.hits); !hit) return hit;
    if (auto found = m_tracer.filteredSurfaces(samples.rays, samples.hits, spread(), samples.surfaces); !found)
        return found;
    samples.seen.clear();
    for (std::uint32_t i = 0; i < samples.hits.size(); ++i)
        if (samples.hits[i].valid()) samples.seen.push_back(i);
    return {};
}

Result<void> TileRenderer::queryField(TileSamples& samples) const {
    samples.irradiance.assign(samples.seen.size(), glm::vec3(0.0f));
    if (!m_field) return {};
    samples.queries.clear();
    for (const std::uint32_t index : samples.seen) {
        const Surface& surface = samples.surfaces[index];
        samples.queries.push_back({surface.position, surface.shadingNormal, -samples.rays[index].direction});
    }
    return m_field->irradiance(samples.queries, samples.irradiance);
}

void TileRenderer::resolve(const Tile& tile, const TileSamples& samples, Picture& picture) const {
    const std::uint32_t perPixel = std::uint32_t(m_desc.samplesPerAxis * m_desc.samplesPerAxis);
    std::uint32_t sample = 0;
    std::size_t entry = 0;
    for (int y = tile.y; y < tile.y + tile.height; ++y)
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            PixelSum sum;
            for (const std::uint32_t end = sample + perPixel; sample < end; ++sample) {
                if (!samples.hits[sample].valid()) {
                    sum.sky += skyRadiance(m_lighting.sky, samples.rays[sample].direction);
                    continue;
                }
                const Surface& surface = samples.surfaces[sample];
                const glm::vec3 e = surface.backface ? glm::vec3(0.0f) : samples.irradiance[entry];
                sum.addSurface(surface, samples.hits[sample].distance, samples.direct[entry], e);
                ++entry;
            }
            sum.store(picture, std::size_t(y) * std::size_t(m_desc.width) + std::size_t(x), 1.0f / float(perPixel));
        }
}

PictureTimes TileRenderer::threadTimes() const {
    return {double(m_primaryNs) * 1e-6, double(m_directNs) * 1e-6, double(m_queryNs) * 1e-6, 0};
}

}  // namespace probegi
