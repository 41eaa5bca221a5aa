#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "probegi/control.h"
#include "probegi/export.h"
#include "probegi/tracer.h"

namespace probegi {

/// What kind of thing changed.
enum class EditKind : std::uint8_t {
    light,   ///< a punctual light
    sky,     ///< Lighting::sky
    object,  ///< an instance of a mesh
};

/// A difference between two states of a scene that probes should hear of (section 4.3).
struct SceneEdit {
    EditKind kind = EditKind::light;
    /// light: its place in the later list, or, if it went out, in the earlier one; object: its node; sky: -1.
    int index = -1;
    /// How large the change is, 0..1. Lights: share of the light that is another one. Objects: the largest way of a
    /// corner of its box, over the box's diagonal; 1 if it came or went.
    float size = 0;
    FieldEvent event = FieldEvent::smallLightChange;
    bool everywhere = false;  ///< the sky or a sun: all probes
    /// Metres; where not everywhere: the box around what light to or from the change can reach.
    Bounds region{};
};

/// The edits that lead from one state of a scene to another. Small ones are left to the field, which follows by
/// itself: changes of a light below a quarter of it (what Listing 3 counts as significant; from 0.8 on they are large),
/// ways of an object below a tenth of its size (from a quarter on they are large), and objects smaller than 0.3 times
/// their mean distance to what they see, since they hide little of it.
/// Lights that differ are compared in the order of the lists. A light that moves by half its mean distance to what it
/// lights, a sun or a spot that turns by 0.3 rad (a sun: an hour), count as another one.
/// The region holds all that the light or the object, before and after, sees directly or by one bounce: it shadows and
/// lights nothing else. It is found by 256 rays (a light that moves: as many for both of its places) through `tracer`,
/// which must be in the later state, so what is behind a narrow gap may be missed; then those probes follow more
/// slowly, as without an event. The same edits for the same states. The scene must be valid. Errors: outOfMemory, and
/// those of the tracer.
PROBEGI_API Result<std::vector<SceneEdit>> findEdits(const Scene& scene, const ScenePose& poseBefore,
                                                     const Lighting& before, const ScenePose& poseAfter,
                                                     const Lighting& after, const Tracer& tracer);

/// Announces edits to a field.
PROBEGI_API void notify(FieldControl& control, std::span<const SceneEdit> edits) noexcept;

/// Finds edits from frame to frame. An object that moves slowly is an edit whenever enough of its way has come
/// together; lights are compared with the frame before. Move-only.
class PROBEGI_API SceneWatch {
public:
    /// The scene must be valid and outlive the watch.
    SceneWatch(const Scene& scene, const ScenePose& pose, const Lighting& lighting);
    SceneWatch(SceneWatch&&) noexcept;
    SceneWatch& operator=(SceneWatch&&) noexcept;
    ~SceneWatch();

    /// What is new since it was last told of. `tracer`: as of findEdits(). Errors: the same; the watch then still
    /// compares with what it compared with before.
    Result<std::vector<SceneEdit>> edits(const ScenePose& pose, const Lighting& lighting, const Tracer& tracer);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace probegi
