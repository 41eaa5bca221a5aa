#include "animation/moving_scene.h"

#include <chrono>
#include <glm/ext/matrix_transform.hpp>
#include <vector>

#include "sdf_scene.h"

namespace probegi::tool {

namespace {

using Clock = std::chrono::steady_clock;

// Files hide objects by scaling them to nothing, which a pose leaves out, but a tracer wants all that moves to be
// somewhere: so it gets them as specks.
constexpr float kSpeck = 1e-5f;

// The nodes that animations move.
std::vector<bool> movingNodes(const Scene& scene) {
    std::vector<bool> moves(scene.nodes.size(), false);
    for (const AnimationChannel& channel : scene.animations) moves[std::size_t(channel.node)] = true;
    for (std::size_t i = 0; i < moves.size(); ++i)  // parents come first
        if (scene.nodes[i].parent >= 0 && moves[std::size_t(scene.nodes[i].parent)]) moves[i] = true;
    return moves;
}

ScenePose withHiddenAsSpecks(const Scene& scene, ScenePose pose) {
    std::vector<bool> missing = movingNodes(scene);
    for (const Instance& instance : pose.instances) missing[std::size_t(instance.node)] = false;
    const glm::mat4 speck = glm::scale(glm::translate(glm::mat4(1.0f), pose.bounds.centre()), glm::vec3(kSpeck));
    for (std::size_t node = 0; node < missing.size(); ++node)
        if (missing[node] && scene.nodes[node].mesh >= 0)
            pose.instances.push_back({scene.nodes[node].mesh, int(node), speck});
    return pose;
}

double millisecondsSince(Clock::time_point& start) {
    const auto now = Clock::now();
    const double passed = std::chrono::duration<double, std::milli>(now - start).count();
    start = now;
    return passed;
}

}  // namespace

// What moves must be announced, or probes in the air would sleep through it; volumes that follow the camera follow.
Result<void> MovingScene::tellField() {
    if (!m_field) return {};
    const std::vector<Bounds> moving = movingBounds(*m_setup->scene, m_setup->pose);
    if (auto told = m_field->control().setMoving(moving); !told) return told;
    if (m_setup->settings.camera)
        if (auto followed = m_field->followCamera(m_setup->camera.position); !followed) return followed;
    return setBudget(*m_field, *m_setup, *m_options);
}

Result<void> MovingScene::moveGuard(const ScenePose& pose) {
    if (!m_field || m_field->control().settings().guard != LeakGuard::sdfShadow) return {};
    FieldSettings settings = m_field->control().settings();
    if (auto placed = placeGuard(settings, *m_setup, pose); !placed) return placed;
    return m_field->control().setSettings(settings);
}

Result<void> MovingScene::bakeMasks() {
    if (!m_field || !m_options->masks.bakes()) return {};
    const auto plan = planMasks(*m_field, *m_tracer, *m_setup, m_options->masks);
    if (!plan) return plan.error();
    const std::vector<OrientedBox> boxes =
        movingBoxes(*m_setup->scene, withHiddenAsSpecks(*m_setup->scene, m_setup->pose));
    auto updater = MaskUpdater::create(*m_context, *m_tracer, m_field->desc(), (*plan)->desc, boxes);
    if (!updater) return updater.error();
    m_masks.emplace(std::move(*updater));
    return useMasks(*m_field, m_masks->masks());
}

Result<void> MovingScene::moveMasks(const ScenePose& pose, MoveTimes& times) {
    if (!m_masks) return {};
    if (auto moved = m_masks->move(movingBoxes(*m_setup->scene, pose)); !moved) return moved;
    const auto updated = m_masks->update(*m_tracer, {.milliseconds = m_options->masks.budget});
    if (!updated) return updated.error();
    times.maskCells = updated->solvedCells;
    times.masksSettled = updated->settled;
    return updated->published ? useMasks(*m_field, m_masks->masks()) : Result<void>();
}

Result<void> MovingScene::settleMasks() {
    if (!m_masks || m_masks->settled()) return {};
    const auto updated = m_masks->update(*m_tracer);
    return updated ? useMasks(*m_field, m_masks->masks()) : Result<void>(updated.error());
}

Result<MovingScene> MovingScene::open(const Context& context, const Backend& backend, LoadedSetup& setup,
                                      const RenderOptions& options) {
    MovingScene moving;
    moving.m_context = &context;
    moving.m_setup = &setup;
    moving.m_options = &options;
    const ScenePose pose = withHiddenAsSpecks(*setup.scene, setup.pose);
    auto tracer = backend.openMovableScene(*setup.scene, pose);
    if (!tracer) return tracer.error();
    moving.m_tracer = std::move(*tracer);
    auto probeTracer = openProbeTracer(backend, setup, pose);
    if (!probeTracer) return probeTracer.error();
    moving.m_probeTracer = std::move(*probeTracer);
    auto field = makeEmptyField(backend, setup, options, pose);
    if (!field) return field.error();
    moving.m_field = std::move(*field);
    moving.watchFromHere();
    return moving;
}

Result<FieldRun> MovingScene::fill() {
    if (!m_field) return FieldRun();
    if (auto told = tellField(); !told) return told.error();
    if (auto baked = bakeMasks(); !baked) return baked.error();
    return runField(*m_field, probeTracer(), m_setup->lighting, m_options->run);
}

void MovingScene::watchFromHere() {
    if (m_field && m_options->events) m_watch.emplace(*m_setup->scene, m_setup->pose, m_setup->lighting);
}

Result<MoveTimes> MovingScene::moveTo(double seconds, int updates) {
    MoveTimes times;
    auto start = Clock::now();
    if (auto moved = moveSetup(*m_setup, m_options->scene, float(seconds)); !moved) return moved.error();
    const ScenePose pose = withHiddenAsSpecks(*m_setup->scene, m_setup->pose);
    if (!m_setup->scene->animations.empty()) {
        for (MovableTracer* tracer : {m_tracer.get(), m_probeTracer.get()}) {
            if (!tracer) continue;
            if (auto moved = tracer->setPose(pose); !moved) return moved.error();
        }
        if (auto moved = moveGuard(pose); !moved) return moved.error();
    }
    times.pose = millisecondsSince(start);
    if (m_watch) {
        const auto edits = m_watch->edits(m_setup->pose, m_setup->lighting, *m_tracer);
        if (!edits) return edits.error();
        notify(m_field->control(), *edits);
        times.editsFound = int(edits->size());
    }
    times.edits = millisecondsSince(start);
    if (auto moved = moveMasks(pose, times); !moved) return moved.error();
    times.masks = millisecondsSince(start);
    if (auto told = tellField(); !told) return told.error();
    for (int i = 0; m_field && i < updates; ++i) {
        times.updated.push_back(m_field->control().tasks().size());
        if (const auto updated = m_field->update(probeTracer(), m_setup->lighting); !updated) return updated.error();
    }
    times.update = millisecondsSince(start);
    return times;
}

}  // namespace probegi::tool
