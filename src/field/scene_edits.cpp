#include <algorithm>
#include <glm/common.hpp>
#include <new>

#include "field/changed_lights.h"
#include "field/edit_reach.h"
#include "field/moved_objects.h"
#include "probegi/edits.h"

namespace probegi {

namespace {

// Listing 3's thresholds, here on the share of a light that is another one.
constexpr float kSignificantChange = 0.25f;
constexpr float kNewDistribution = 0.8f;
// Ways of an object over its size.
constexpr float kSmallWay = 0.1f, kLargeWay = 0.25f;
// Size of an object over its mean distance to what it sees: a smaller one hides too little of the scene.
constexpr float kLeastExtent = 0.3f;
// Objects whose reach is looked for one by one; further ones share a box.
constexpr std::size_t kMostObjects = 16;

FieldEvent lightEvent(float change) {
    return change >= kNewDistribution ? FieldEvent::largeLightChange : FieldEvent::smallLightChange;
}

FieldEvent objectEvent(float way) {
    return way >= kLargeWay ? FieldEvent::largeObjectChange : FieldEvent::smallObjectChange;
}

Bounds joined(const Bounds& a, const Bounds& b) {
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

// Of a light of the list; null if it was off.
const PlacedLight* lightAt(const std::vector<PlacedLight>& lights, int index) {
    return index < 0 ? nullptr : &lights[std::size_t(index)];
}

EditSource sourceOf(const PlacedLight& light) {
    EditSource source{{light.position, light.position}, light.range};
    if (light.type == LightType::spot) {
        source.axis = light.direction;
        source.cosCone = light.cosOuter;
    }
    return source;
}

/// What changed, before it is known how far that reaches.
struct Changes {
    const std::vector<PlacedLight>&before, &after;
    std::vector<LightPair> lights;
    std::vector<MovedObject> objects;
    float sky = 0;

    template <class Visit>
    void eachPlacedLight(const LightPair& pair, const Visit& visit) const {
        for (const PlacedLight* light : {lightAt(before, pair.before), lightAt(after, pair.after)})
            if (light && light->type != LightType::directional) visit(*light);
    }

    /// Those of the lights, each before and after, then those of the objects.
    std::vector<EditSource> sources() const {
        std::vector<EditSource> all;
        for (const LightPair& pair : lights)
            eachPlacedLight(pair, [&](const PlacedLight& light) { all.push_back(sourceOf(light)); });
        for (std::size_t i = 0; i < objects.size(); ++i)
            if (i < kMostObjects)
                all.push_back({objects[i].box});
            else
                all.back().box = joined(all.back().box, objects[i].box);
        return all;
    }
};

// Takes the light's reaches, from `next` on.
SceneEdit lightEdit(const Changes& changes, const LightPair& pair, const std::vector<EditReach>& reaches,
                    std::size_t& next) {
    const PlacedLight *before = lightAt(changes.before, pair.before), *after = lightAt(changes.after, pair.after);
    SceneEdit edit{EditKind::light, after ? pair.after : pair.before};
    edit.everywhere = (before ? before : after)->type == LightType::directional;
    float distance = 0;
    bool first = true;
    changes.eachPlacedLight(pair, [&](const PlacedLight&) {
        const EditReach& reach = reaches[next++];
        edit.region = first ? reach.box : joined(edit.region, reach.box);
        distance = std::max(distance, reach.meanDistance);
        first = false;
    });
    edit.size = before && after ? lightChange(*before, *after, distance) : 1.0f;
    edit.event = lightEvent(edit.size);
    return edit;
}

std::vector<SceneEdit> editsOf(const Changes& changes, const std::vector<EditReach>& reaches) {
    std::vector<SceneEdit> edits;
    if (changes.sky >= kSignificantChange)
        edits.push_back({EditKind::sky, -1, changes.sky, lightEvent(changes.sky), true});
    std::size_t next = 0;
    for (const LightPair& pair : changes.lights)
        if (const SceneEdit edit = lightEdit(changes, pair, reaches, next); edit.size >= kSignificantChange)
            edits.push_back(edit);
    for (const MovedObject& object : changes.objects) {
        const EditReach& reach = reaches[next];
        if (object.extent >= kLeastExtent * reach.meanDistance)
            edits.push_back({EditKind::object, object.node, object.size, objectEvent(object.size), false, reach.box});
        next = std::min(next + 1, reaches.size() - 1);
    }
    return edits;
}

}  // namespace

Result<std::vector<SceneEdit>> findEdits(const Scene& scene, const ScenePose& poseBefore, const Lighting& before,
                                         const ScenePose& poseAfter, const Lighting& after, const Tracer& tracer) try {
    const Changes changes{before.lights, after.lights, changedLights(before.lights, after.lights),
                          movedObjects(scene, poseBefore, poseAfter, kSmallWay), skyChange(before.sky, after.sky)};
    const std::vector<EditSource> sources = changes.sources();
    if (sources.empty()) return editsOf(changes, {});
    const auto reaches = findReaches(tracer, sources);
    if (!reaches) return reaches.error();
    return editsOf(changes, *reaches);
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory to compare two states of the scene");
}

void notify(FieldControl& control, std::span<const SceneEdit> edits) noexcept {
    for (const SceneEdit& edit : edits)
        if (edit.everywhere)
            control.notify(edit.event);
        else
            control.notify(edit.event, edit.region);
}

struct SceneWatch::Impl {
    const Scene& scene;
    ScenePose pose;  ///< each instance as it was last told of
    Lighting lighting;

    void settle(const std::vector<SceneEdit>& edits, const ScenePose& now, const Lighting& lightsNow);
};

// Objects that have moved too little go on being compared with where they were; everything else is from now on as it
// is. Lights, too: the field's fixed rays follow what is slow, and events would only add noise.
void SceneWatch::Impl::settle(const std::vector<SceneEdit>& edits, const ScenePose& now, const Lighting& lightsNow) {
    for (const SceneEdit& edit : edits) {
        if (edit.kind == EditKind::sky) lighting.sky = lightsNow.sky;
        if (edit.kind != EditKind::object) continue;
        std::erase_if(pose.instances, [&](const Instance& instance) { return instance.node == edit.index; });
        for (const Instance& instance : now.instances)
            if (instance.node == edit.index) pose.instances.push_back(instance);
    }
    lighting.lights = lightsNow.lights;
}

SceneWatch::SceneWatch(const Scene& scene, const ScenePose& pose, const Lighting& lighting)
    : m_impl(new Impl{scene, pose, lighting}) {}
SceneWatch::SceneWatch(SceneWatch&&) noexcept = default;
SceneWatch& SceneWatch::operator=(SceneWatch&&) noexcept = default;
SceneWatch::~SceneWatch() = default;

Result<std::vector<SceneEdit>> SceneWatch::edits(const ScenePose& pose, const Lighting& lighting,
                                                 const Tracer& tracer) {
    auto found = findEdits(m_impl->scene, m_impl->pose, m_impl->lighting, pose, lighting, tracer);
    if (found) m_impl->settle(*found, pose, lighting);
    return found;
}

}  // namespace probegi
