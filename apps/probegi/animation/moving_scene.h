#pragma once

#include <memory>
#include <optional>

#include "probegi/edits.h"
#include "probegi/mask_updater.h"
#include "render_options.h"

namespace probegi::tool {

/// Times of one step, milliseconds.
struct MoveTimes {
    double pose = 0;    ///< the scene's and the tracer's
    double edits = 0;   ///< to find them
    double masks = 0;   ///< what moved costs the masks
    double update = 0;  ///< all updates together
    int editsFound = 0;
    std::size_t maskCells = 0;           ///< whose masks were solved again
    bool masksSettled = true;            ///< masks are those of the scene as it is
    std::vector<std::size_t> updated{};  ///< probes of each update
};

/// A scene, its tracer and its field, taken through time as an engine does: the pose changes, the field is told and
/// updated, and keeps what it knows.
class MovingScene {
public:
    /// At the setup's pose, with a field that holds nothing yet. All must outlive it. Errors: those of the backend.
    static Result<MovingScene> open(const Context& context, const Backend& backend, LoadedSetup& setup,
                                    const RenderOptions& options);

    /// Fills the field for the scene as it is. Errors: those of runField().
    Result<FieldRun> fill();
    /// To another moment, in seconds, followed by so many updates. Errors: those of the tracer and the field.
    Result<MoveTimes> moveTo(double seconds, int updates);
    /// Finishes the masks of the scene as it is, whatever --mask-budget says. Errors: those of the tracer.
    Result<void> settleMasks();
    /// Forgets what moved since: edits are found against the scene as it is now.
    void watchFromHere();

    const Tracer& tracer() const { return *m_tracer; }
    const LoadedSetup& setup() const { return *m_setup; }
    Field* field() { return m_field ? &*m_field : nullptr; }

private:
    MovingScene() = default;
    Result<void> tellField();
    /// LeakGuard::sdfShadow.
    Result<void> moveGuard(const ScenePose& pose);
    Result<void> bakeMasks();
    Result<void> moveMasks(const ScenePose& pose, MoveTimes& times);
    /// What probe rays hit.
    const Tracer& probeTracer() const { return m_probeTracer ? *m_probeTracer : *m_tracer; }

    const Context* m_context = nullptr;
    LoadedSetup* m_setup = nullptr;
    const RenderOptions* m_options = nullptr;
    std::unique_ptr<MovableTracer> m_tracer;
    std::unique_ptr<MovableTracer> m_probeTracer;  // null: probe rays hit what pictures show
    std::optional<Field> m_field;
    std::optional<SceneWatch> m_watch;
    std::optional<MaskUpdater> m_masks;
};

}  // namespace probegi::tool
