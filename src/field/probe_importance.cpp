#include "field/probe_importance.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace probegi {

namespace {

// Distance at which importance is halved, in mean spacings of the volume.
constexpr float kNearCells = 8.0f;
// What is left far away, so that what is seen from far is not forgotten.
constexpr float kFarShare = 0.05f;
// Of probes that light nothing in the view: the camera may turn.
constexpr float kUnseenShare = 0.25f;
// A probe lights what is within its cells, in largest spacings.
constexpr float kReachCells = 1.5f;

}  // namespace

ProbeImportance::ProbeImportance(const std::optional<BudgetView>& view, const FieldSettings& settings)
    : m_eye(view ? std::optional(view->camera.position) : settings.camera), m_view(view) {
    if (!view) return;
    const float tangent = std::tan(0.5f * view->camera.yfov);
    m_right = glm::cross(view->camera.forward, view->camera.up);
    m_tangents = {tangent * view->aspect, tangent};
    m_stretches = glm::sqrt(1.0f + m_tangents * m_tangents);
}

bool ProbeImportance::isInView(glm::vec3 position, float reach) const noexcept {
    const glm::vec3 to = position - *m_eye;
    const float along = glm::dot(to, m_view->camera.forward);
    const glm::vec2 aside(std::abs(glm::dot(to, m_right)), std::abs(glm::dot(to, m_view->camera.up)));
    if (along < -reach) return false;
    for (int axis = 0; axis < 2; ++axis)
        if (aside[axis] - along * m_tangents[axis] > reach * m_stretches[axis]) return false;
    return true;
}

float ProbeImportance::at(const kernels::Volume& volume, glm::vec3 position) const noexcept {
    if (!m_eye) return 1.0f;
    const glm::vec3 spacing = 1.0f / volume.inverseSpacing;
    const float mean = (spacing.x + spacing.y + spacing.z) / 3.0f;
    const float share = glm::distance(position, *m_eye) / (kNearCells * mean);
    const float near = kFarShare + (1.0f - kFarShare) / (1.0f + share * share);
    const float largest = std::max({spacing.x, spacing.y, spacing.z});
    return m_view && !isInView(position, kReachCells * largest) ? kUnseenShare * near : near;
}

}  // namespace probegi
