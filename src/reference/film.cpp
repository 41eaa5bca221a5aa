#include "reference/film.h"

#include <glm/geometric.hpp>
#include <limits>

#include "kernels/screen/colour.h"

namespace probegi {

namespace {

bool isFinite(const PathResult& p) {
    // One sum detects any NaN or infinity; its own overflow is irrelevant, since no picture has such radiances.
    const glm::vec3 sum = p.sky + p.direct + p.indirect + p.irradiance + p.albedo + p.normal + glm::vec3(p.depth);
    return std::isfinite(sum.x + sum.y + sum.z);
}

void average(PathResult& mean, const PathResult& p, float share) {
    mean.sky += (p.sky - mean.sky) * share;
    mean.direct += (p.direct - mean.direct) * share;
    mean.indirect += (p.indirect - mean.indirect) * share;
    mean.irradiance += (p.irradiance - mean.irradiance) * share;
    mean.albedo += (p.albedo - mean.albedo) * share;
    mean.normal += (p.normal - mean.normal) * share;
    mean.depth += (p.depth - mean.depth) * share;
}

}  // namespace

Film::Film(int width, int height)
    : m_width(width), m_height(height), m_pixels(std::size_t(width) * std::size_t(height)) {}

void Film::add(std::size_t index, const PathResult& path) noexcept {
    Pixel& pixel = m_pixels[index];
    const bool finite = isFinite(path);
    if (!finite) ++pixel.rejected;
    const PathResult sample = finite ? path : PathResult{};
    pixel.color.add(glm::dvec3(sample.color()));
    average(pixel.mean, sample, 1.0f / float(pixel.color.count));
}

double Film::relativeError() const noexcept {
    double error = 0, level = 0;
    for (const Pixel& pixel : m_pixels) {
        if (pixel.color.count < 2) return std::numeric_limits<double>::infinity();
        error += double(kernels::luminance(glm::vec3(pixel.color.standardError())));
        level += double(kernels::luminance(glm::vec3(pixel.color.mean)));
    }
    return error > 0 ? error / level : 0;
}

std::int64_t Film::rejectedCount() const noexcept {
    std::int64_t sum = 0;
    for (const Pixel& pixel : m_pixels) sum += pixel.rejected;
    return sum;
}

ReferencePicture Film::develop() const {
    const HdrImage blank(m_width, m_height);
    ReferencePicture out{{blank, blank, blank, blank, blank, blank, blank}, blank};
    for (std::size_t i = 0; i < m_pixels.size(); ++i) {
        const Pixel& pixel = m_pixels[i];
        out.picture.color.pixels[i] = glm::vec3(pixel.color.mean);
        out.standardError.pixels[i] = glm::vec3(pixel.color.standardError());
        out.picture.direct.pixels[i] = pixel.mean.direct;
        out.picture.indirect.pixels[i] = pixel.mean.indirect;
        out.picture.irradiance.pixels[i] = pixel.mean.irradiance;
        out.picture.albedo.pixels[i] = pixel.mean.albedo;
        out.picture.normal.pixels[i] = pixel.mean.normal;
        out.picture.depth.pixels[i] = glm::vec3(pixel.mean.depth);
    }
    return out;
}

}  // namespace probegi
