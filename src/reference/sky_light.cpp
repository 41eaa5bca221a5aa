#include "reference/sky_light.h"

#include <algorithm>
#include <cmath>

#include "kernels/sampling.h"
#include "kernels/screen/colour.h"
#include "scene/sky_radiance.h"

namespace probegi {

namespace {

constexpr double kTau = 2 * 3.14159265358979323846;

/// Cosine of the polar angle of the upper edge of row y.
double rowCosine(int y, int height) {
    return std::cos(0.5 * kTau * y / height);
}

/// Mean luminance over a texel's area of the bilinearly interpolated image: per axis, the texel itself counts 3/4 and
/// each neighbour 1/8. It is positive wherever a look-up is.
double meanTexelLuminance(const HdrImage& image, int x, int y) {
    constexpr double kShare[3] = {0.125, 0.75, 0.125};
    double sum = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const glm::vec3& texel =
                image.at((x + dx + image.width) % image.width, std::clamp(y + dy, 0, image.height - 1));
            sum += kShare[dx + 1] * kShare[dy + 1] * std::max(0.0, double(kernels::luminance(texel)));
        }
    return sum;
}

}  // namespace

SkyLight::SkyLight(const Sky& sky) : m_sky(sky), m_black(sky.black()) {
    if (sky.textured() && !m_black) makeTable();
}

void SkyLight::makeTable() {
    const HdrImage& image = m_sky.image;
    std::vector<double> weights(image.pixels.size());
    m_pdf.resize(weights.size());
    for (int y = 0; y < image.height; ++y) {
        const double solidAngle = (rowCosine(y, image.height) - rowCosine(y + 1, image.height)) * kTau / image.width;
        for (int x = 0; x < image.width; ++x) {
            const std::size_t i = std::size_t(y) * image.width + x;
            const double mean = meanTexelLuminance(image, x, y);
            weights[i] = mean * solidAngle;
            m_pdf[i] = float(mean);
        }
    }
    m_table = AliasTable(weights);
    m_black = m_table.empty();
    for (float& density : m_pdf) density /= float(m_table.totalWeight());
}

glm::vec3 SkyLight::radiance(glm::vec3 direction) const noexcept {
    return m_black ? glm::vec3(0.0f) : skyRadiance(m_sky, direction);
}

glm::vec3 SkyLight::sample(glm::vec3 normal, Random& random) const noexcept {
    if (m_table.empty()) {
        const glm::mat3 frame = kernels::orthonormalBasis(normal);
        return kernels::toWorld(frame, kernels::sampleCosineHemisphere(random.nextPair()));
    }
    const int width = m_sky.image.width, height = m_sky.image.height;
    const std::size_t texel = m_table.sample(random.nextDouble());
    const int x = int(texel % std::size_t(width)), y = int(texel / std::size_t(width));
    // Uniform over the texel's solid angle; as in kernels/light/sky.h, u = 1/2 is -Z and grows towards +X.
    const double top = rowCosine(y, height), bottom = rowCosine(y + 1, height);
    const double cosine = top + (bottom - top) * random.nextDouble();
    const double phi = ((x + random.nextDouble()) / width - 0.5) * kTau;
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return {float(sine * std::sin(phi)), float(cosine), float(-sine * std::cos(phi))};
}

float SkyLight::pdf(glm::vec3 normal, glm::vec3 direction) const noexcept {
    if (m_table.empty()) return kernels::pdfCosineHemisphere(glm::dot(normal, direction));
    const int width = m_sky.image.width, height = m_sky.image.height;
    const glm::vec2 uv = kernels::skyUv(direction);
    const int x = std::min(int(uv.x * float(width)), width - 1), y = std::min(int(uv.y * float(height)), height - 1);
    return m_pdf[std::size_t(y) * width + x];
}

}  // namespace probegi
