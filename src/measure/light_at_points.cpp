#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "measure/input_checks.h"
#include "measure/luminance.h"
#include "probegi/measure.h"

namespace probegi {

std::vector<FieldQuery> wallPoints(const Bounds& room, int perSide) {
    std::vector<FieldQuery> points;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool far : {false, true})
            for (int i = 0; i < perSide * perSide; ++i) {
                glm::vec3 share;
                share[axis] = far ? 1.0f : 0.0f;
                share[(axis + 1) % 3] = (float(i % perSide) + 0.5f) / float(perSide);
                share[(axis + 2) % 3] = (float(i / perSide) + 0.5f) / float(perSide);
                glm::vec3 normal(0);
                normal[axis] = far ? -1.0f : 1.0f;
                const glm::vec3 position = room.lower + share * room.size();
                points.push_back({position, normal, glm::normalize(room.centre() - position)});
            }
    return points;
}

Result<std::vector<double>> lightAt(const Field& field, std::span<const FieldQuery> points) {
    return withinMemory("ask the field", [&]() -> Result<std::vector<double>> {
        std::vector<glm::vec3> irradiance(points.size());
        if (const auto asked = field.irradiance(points, irradiance); !asked) return asked.error();
        std::vector<double> light;
        light.reserve(irradiance.size());
        for (const glm::vec3& e : irradiance) light.push_back(channelMean(e));
        return light;
    });
}

Result<double> meanLight(const Field& field, std::span<const FieldQuery> points) {
    const auto light = lightAt(field, points);
    if (!light) return light.error();
    if (light->empty()) return 0.0;
    return std::accumulate(light->begin(), light->end(), 0.0) / double(light->size());
}

Result<double> leakShare(const Field& field, std::span<const FieldQuery> sealed, std::span<const FieldQuery> lit) {
    const auto dark = meanLight(field, sealed);
    if (!dark) return dark;
    const auto bright = meanLight(field, lit);
    if (!bright) return bright;
    return *bright > 0 ? *dark / *bright : std::numeric_limits<double>::infinity();
}

Result<LightDifference> compareLight(std::span<const double> light, std::span<const double> reference) {
    if (auto ok = checkSameCount("light", light.size(), reference.size()); !ok) return ok.error();
    double sum = 0, expected = 0, squares = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        sum += light[i];
        expected += reference[i];
        squares += (light[i] - reference[i]) * (light[i] - reference[i]);
    }
    if (!(expected > 0)) return LightDifference{};
    return LightDifference{sum / expected, std::sqrt(squares * double(light.size())) / expected};
}

}  // namespace probegi
