#pragma once

#include "kernels/volume/volume.h"
#include "probegi/control.h"

namespace probegi {

/// How much the probes of a field matter to a viewer, 0..1: nearer ones more, and more what a view shows. 1 for all
/// where nothing is known of a viewer.
class ProbeImportance {
public:
    /// The view, else the camera of the settings.
    ProbeImportance(const std::optional<BudgetView>& view, const FieldSettings& settings);

    /// Of a probe there, of a volume: metres, in the world.
    float at(const kernels::Volume& volume, glm::vec3 position) const noexcept;

private:
    bool isInView(glm::vec3 position, float reach) const noexcept;

    std::optional<glm::vec3> m_eye;
    std::optional<BudgetView> m_view;
    glm::vec3 m_right{1, 0, 0};
    glm::vec2 m_tangents{0.0f};   // of half the angles of view
    glm::vec2 m_stretches{1.0f};  // from a distance along the axis to one from the sides of the pyramid
};

}  // namespace probegi
