#include "room_field.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "kernels/trace/ray_set.h"

namespace probegi::bench {

namespace {

constexpr float kWall = 10.0f;  // the room is a cube with its middle at the origin, this far to each wall

struct WallHit {
    float distance;
    glm::vec3 normal;  // into the room
};

WallHit hitWall(glm::vec3 origin, glm::vec3 direction) {
    WallHit nearest{1e30f, glm::vec3(0.0f)};
    for (int axis = 0; axis < 3; ++axis) {
        const float side = direction[axis] < 0 ? -1.0f : 1.0f;
        const float distance = (side * kWall - origin[axis]) / (direction[axis] + side * 1e-20f);
        if (distance >= nearest.distance) continue;
        nearest = {distance, glm::vec3(0.0f)};
        nearest.normal[axis] = -side;
    }
    return nearest;
}

RayDatum datum(glm::vec3 origin, glm::vec3 direction) {
    const WallHit hit = hitWall(origin, direction);
    const glm::vec3 white = 1.1f + hit.normal;  // each wall has its own light
    return {white * (0.1f + std::abs(direction.x)), hit.distance};
}

FieldDesc makeDesc(glm::ivec3 counts, int raysPerProbe) {
    FieldDesc desc;
    desc.volumes[0].counts = counts;
    desc.volumes[0].spacing = glm::vec3(1.9f * kWall) / glm::vec3(counts - 1);
    desc.volumes[0].origin = glm::vec3(-0.95f * kWall);
    desc.raysPerProbe = raysPerProbe;
    return desc;
}

}  // namespace

RoomField::RoomField(LeakGuard guard, glm::ivec3 counts, int raysPerProbe)
    : m_context(*Context::create({.threads = 1})),
      m_desc(makeDesc(counts, raysPerProbe)),
      m_settings{.guard = guard},
      m_control(makeFieldControl(m_desc, m_settings)),
      m_volumes(makeVolumes(m_desc)),
      m_layout(m_desc),
      m_storage(m_layout),
      m_irradianceTaps(makeTapTable(m_desc.irradianceTexels)),
      m_visibilityTaps(makeTapTable(m_desc.visibilityTexels)) {
    for (std::uint32_t i = 0; i < m_layout.rays; ++i)
        m_directions.push_back(kernels::sphericalFibonacci(i, std::uint32_t(m_layout.rays)));
    for (const ProbeTask& task : tasks())
        for (const glm::vec3& direction : m_directions) m_rayData.push_back(datum(task.origin, direction));
    BlendWeights weights;
    makeBlendWeights(m_context, m_desc, m_settings.visibilityExponent, m_directions, weights);
    blendProbes(m_context, m_desc, m_volumes, m_settings, weights, m_rayData, {tasks(), {0.0f, 0.0f}}, m_storage);
}

FieldView RoomField::view() const {
    return {.volumes = m_volumes,
            .slots = int(m_layout.probes),
            .irradianceTexels = m_desc.irradianceTexels,
            .visibilityTexels = m_desc.visibilityTexels,
            .selfShadowBias = m_settings.selfShadowBias,
            .guard = m_settings.guard,
            .rules = m_desc.rules,
            .irradiance = m_storage.irradiance.data(),
            .visibility = m_storage.visibility.data(),
            .backfaceShare = m_storage.backfaceShare.data(),
            .irradianceTaps = &m_irradianceTaps,
            .visibilityTaps = &m_visibilityTaps};
}

std::vector<FieldQuery> RoomField::screenPoints(int width, int height) const {
    const glm::vec3 eye(0.6f * kWall, 0.2f * kWall, 0.5f * kWall);
    std::vector<FieldQuery> points;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float across = 2.0f * (float(x) + 0.5f) / float(width) - 1.0f;
            const float down = 2.0f * (float(y) + 0.5f) / float(height) - 1.0f;
            const glm::vec3 direction = glm::normalize(glm::vec3(-1.0f, -0.2f - 0.5f * down, 0.9f * across - 0.4f));
            const WallHit hit = hitWall(eye, direction);
            points.push_back({eye + hit.distance * direction, hit.normal, -direction});
        }
    return points;
}

std::vector<FieldQuery> shuffled(std::vector<FieldQuery> points) {
    std::shuffle(points.begin(), points.end(), std::mt19937(1));
    return points;
}

}  // namespace probegi::bench
