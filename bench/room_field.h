#pragma once

#include <vector>

#include "cpu/blend_pass.h"
#include "cpu/field_view.h"
#include "field/control_impl.h"

namespace probegi::bench {

/// A probe field in an empty room with bright and dark walls, whose rays are computed: the same work for a query or a
/// blend as in any scene, without a scene. As large as the published Sponza volume unless told otherwise.
class RoomField {
public:
    explicit RoomField(LeakGuard guard, glm::ivec3 counts = {22, 14, 32}, int raysPerProbe = 144);

    FieldView view() const;
    const Context& context() const { return m_context; }
    const FieldDesc& desc() const { return m_desc; }
    const FieldSettings& settings() const { return m_settings; }
    std::span<const ProbeTask> tasks() const { return m_control.tasks(); }
    const FieldLayout& layout() const { return m_layout; }
    std::span<const glm::vec3> directions() const { return m_directions; }
    std::span<const RayDatum> rayData() const { return m_rayData; }
    FieldStorage& storage() { return m_storage; }

    /// Points on a wall and a floor as a camera sees them, row by row.
    std::vector<FieldQuery> screenPoints(int width, int height) const;

private:
    Context m_context;
    FieldDesc m_desc;
    FieldSettings m_settings;
    FieldControl m_control;
    std::vector<kernels::Volume> m_volumes;
    FieldLayout m_layout;
    FieldStorage m_storage;
    TapTable m_irradianceTaps, m_visibilityTaps;
    std::vector<glm::vec3> m_directions;
    std::vector<RayDatum> m_rayData;
};

/// The same points in an order without any coherence.
std::vector<FieldQuery> shuffled(std::vector<FieldQuery> points);

}  // namespace probegi::bench
