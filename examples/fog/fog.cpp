#include "fog.h"

#include <algorithm>
#include <cmath>

using namespace probegi;

namespace {

constexpr int kSteps = 40;  // along a view ray
constexpr float kPi = 3.14159265f;

/// Like .value(): throws on failure.
void must(const Result<void>& done) {
    if (!done) throw BadResult(done.error());
}

/// Where a ray is inside a box: [first, second], empty if first >= second.
std::pair<float, float> insideBox(const Bounds& box, glm::vec3 origin, glm::vec3 direction, float end) {
    float from = 0, to = end;
    for (int axis = 0; axis < 3; ++axis) {
        const float a = (box.lower[axis] - origin[axis]) / direction[axis],
                    b = (box.upper[axis] - origin[axis]) / direction[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return {from, to};
}

glm::vec3 throughPixel(const PlacedCamera& camera, const HdrImage& image, int x, int y) {
    const float height = std::tan(0.5f * camera.yfov), width = height * float(image.width) / float(image.height);
    const glm::vec3 right = glm::cross(camera.forward, camera.up);
    return glm::normalize(camera.forward + width * (2 * (float(x) + 0.5f) / float(image.width) - 1) * right -
                          height * (2 * (float(y) + 0.5f) / float(image.height) - 1) * camera.up);
}

/// Mean radiance of the directional lights, which the field leaves out, where they are not in shadow.
std::vector<glm::vec3> sunlight(const Tracer& tracer, const Lighting& lighting, std::span<const glm::vec3> points) {
    std::vector<glm::vec3> light(points.size());
    std::vector<Ray> rays(points.size());
    std::vector<std::uint8_t> blocked(points.size());
    for (const PlacedLight& sun : lighting.lights) {
        if (sun.type != LightType::directional) continue;
        for (std::size_t i = 0; i < points.size(); ++i) rays[i] = {.origin = points[i], .direction = -sun.direction};
        must(tracer.occluded(rays, blocked));
        for (std::size_t i = 0; i < points.size(); ++i)
            if (!blocked[i]) light[i] += sun.intensity / (4 * kPi);
    }
    return light;
}

/// The sample points of a row of pixels: kSteps a pixel, `length` metres apart.
struct Row {
    std::vector<glm::vec3> points;
    std::vector<float> length;
};

Row samplesOf(const Fog& fog, const PlacedCamera& camera, const Picture& picture, int y) {
    Row row;
    for (int x = 0; x < picture.color.width; ++x) {
        const glm::vec3 direction = throughPixel(camera, picture.color, x, y);
        const float depth = picture.depth.at(x, y).x;
        const auto [from, to] = insideBox(fog.where, camera.position, direction, depth > 0 ? depth : 1e30f);
        const float length = std::max(0.0f, to - from) / kSteps;
        row.length.push_back(length);
        // Neighbours sample elsewhere, so that steps are not seen as bands.
        const float place = 0.7548777f * float(x) + 0.5698403f * float(y), shift = place - std::floor(place);
        for (int i = 0; i < kSteps; ++i)
            row.points.push_back(camera.position + (std::min(from, to) + (float(i) + shift) * length) * direction);
    }
    return row;
}

}  // namespace

// A uniform light L gives E = pi L in all six directions. Of other light, six cosines are a smooth weighting.
std::vector<glm::vec3> meanRadiance(const Field& field, std::span<const glm::vec3> points) {
    constexpr glm::vec3 kNormals[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<FieldQuery> queries;
    queries.reserve(6 * points.size());
    for (const glm::vec3& point : points)
        for (const glm::vec3& normal : kNormals) queries.push_back({.position = point, .normal = normal});
    std::vector<glm::vec3> irradiance(queries.size()), mean(points.size());
    must(field.irradiance(queries, irradiance));
    for (std::size_t i = 0; i < irradiance.size(); ++i) mean[i / 6] += irradiance[i] / (6 * kPi);
    return mean;
}

void addFog(const Fog& fog, const Field& field, const Tracer& tracer, const Lighting& lighting,
            const PlacedCamera& camera, Picture& picture) {
    for (int y = 0; y < picture.color.height; ++y) {
        const Row row = samplesOf(fog, camera, picture, y);
        const std::vector<glm::vec3> ambient = meanRadiance(field, row.points),
                                     sun = sunlight(tracer, lighting, row.points);
        for (int x = 0; x < picture.color.width; ++x) {
            const float kept = std::exp(-fog.extinction * row.length[std::size_t(x)]);  // by one step
            glm::vec3 scattered(0.0f);
            float transmittance = 1;
            for (int i = 0; i < kSteps; ++i) {
                const std::size_t at = std::size_t(x * kSteps + i);
                scattered += transmittance * (1 - kept) * fog.albedo * (ambient[at] + sun[at]);
                transmittance *= kept;
            }
            glm::vec3& pixel = picture.color.at(x, y);
            pixel = transmittance * pixel + scattered;
        }
    }
}
