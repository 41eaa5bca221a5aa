#include "doors.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <optional>
#include <stdexcept>

#include "probegi/builtin_scenes.h"
#include "probegi/field.h"
#include "probegi/mask_updater.h"
#include "probegi/measure.h"
#include "probegi/shapes.h"

namespace probegi::accuracy {

namespace {

constexpr double kBudgetMs = 10;
constexpr int kFrames = 60;   ///< in which the door opens, and as many in which it shuts
constexpr int kEvery = 5;     ///< of them, the leak is measured
constexpr int kFilled = 100;  ///< updates before
constexpr int kPoints = 20'000;
constexpr float kNear = 1.0f;  ///< metres from the doorway that count as at the door
constexpr float kQuarterTurn = 1.5707963f;
// The doorway between kitchen and study.
constexpr glm::vec3 kHinge(9.204f, 0.0f, 3.3f), kDoor(0.892f, 2.096f, 0.02f);
constexpr Bounds kKitchen{{8.6f, 0.0f, 3.4f}, {11.75f, 2.6f, 7.7f}}, kStudy{{8.6f, 0.0f, 0.25f}, {11.75f, 2.6f, 3.2f}};

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The value; throws the error's message, which measureDoors() catches.
template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

bool inside(const Bounds& room, glm::vec3 p) {
    return glm::all(glm::greaterThan(p, room.lower - 0.01f)) && glm::all(glm::lessThan(p, room.upper + 0.01f));
}

/// The house with a door, on its way between shut (0) and open (1).
class House {
public:
    explicit House(const Context& context) : m_scene(must(makeBuiltinScene("house"))) {
        m_scene.materials.push_back(Material());
        Primitive door;
        addBox(door, {0.0f, 0.004f, -kDoor.z}, {kDoor.x, kDoor.y, kDoor.z});
        door.material = int(m_scene.materials.size()) - 1;
        m_node = addObject(m_scene, std::move(door), "door");
        m_scene.nodes[std::size_t(m_node)].translation = kHinge;
        m_still = m_pose = poseAt(m_scene);
        PlacedLight lamp;
        lamp.type = LightType::point;
        lamp.position = {10.2f, 2.0f, 5.5f};
        lamp.intensity = glm::vec3(20);
        m_night.lights = {lamp};
        m_tracer = must(makeMovableEmbreeTracer(context, m_scene, m_pose, {.nodes = std::span(&m_node, 1)}));
        m_desc.volumes = {must(placeVolume(m_pose.bounds, {.counts = {32, 16, 16}}))};
    }

    void turn(float open) {
        m_pose = m_still;
        for (Instance& instance : m_pose.instances)
            if (instance.node == m_node)
                instance.toWorld = glm::rotate(instance.toWorld, kQuarterTurn * open, {0, 1, 0});
        must(m_tracer->setPose(m_pose));
    }
    OrientedBox door() const {
        OrientedBox box;
        for (const Instance& instance : m_pose.instances) {
            if (instance.node != m_node) continue;
            box.centre = glm::vec3(instance.toWorld * glm::vec4(0.5f * kDoor.x, 0.5f * kDoor.y, 0, 1));
            const glm::vec3 half(0.5f * kDoor.x, 0.5f * kDoor.y, kDoor.z);
            for (int axis = 0; axis < 3; ++axis) box.halfAxes[axis] = glm::vec3(instance.toWorld[axis]) * half[axis];
        }
        return box;
    }
    std::vector<Bounds> occluders() const { return triangleBounds(m_scene, m_pose); }
    const MovableTracer& tracer() const { return *m_tracer; }
    const Lighting& night() const { return m_night; }
    const FieldDesc& desc() const { return m_desc; }

private:
    Scene m_scene;
    int m_node = -1;
    ScenePose m_still, m_pose;
    Lighting m_night;
    std::unique_ptr<MovableTracer> m_tracer;
    FieldDesc m_desc;
};

std::shared_ptr<const Masks> fullBake(const Context& context, const House& house, MaskDesc desc) {
    const std::vector<Bounds> occluders = house.occluders();
    desc.occluders = occluders;
    return must(bakeMasks(context, house.tracer(), house.desc(), desc));
}

/// Points of the two rooms, by where they are.
struct Rooms {
    explicit Rooms(const House& house) {
        const glm::vec3 doorway = kHinge + glm::vec3(0.5f * kDoor.x, 0.5f * kDoor.y, 0);
        for (const FieldQuery& q : must(visiblePoints(house.tracer(), {kStudy.lower, kKitchen.upper}, kPoints))) {
            if (inside(kKitchen, q.position)) kitchen.push_back(q);
            if (inside(kStudy, q.position)) study.push_back(q);
            if (!inside(kKitchen, q.position) && !inside(kStudy, q.position)) continue;
            const glm::vec3 off = glm::abs(q.position - doorway) - glm::vec3(0.5f * kDoor.x, 0.5f * kDoor.y, 0);
            (std::max(off.x, std::max(off.y, off.z)) < kNear ? atDoor : elsewhere).push_back(q);
        }
    }
    std::vector<FieldQuery> kitchen, study, atDoor, elsewhere;
};

void use(Field& field, const std::shared_ptr<const Masks>& masks) {
    FieldSettings settings = field.control().settings();
    settings.guard = LeakGuard::masks;
    settings.masks = masks;
    must(field.control().setSettings(settings));
}

std::vector<double> lightBy(Field& field, const std::shared_ptr<const Masks>& masks,
                            const std::vector<FieldQuery>& points) {
    use(field, masks);
    return must(lightAt(field, points));
}

/// RMS between two masks' light from the same probes, over the mean light of both rooms.
double between(Field& field, const std::shared_ptr<const Masks>& a, const std::shared_ptr<const Masks>& b,
               const std::vector<FieldQuery>& points) {
    return must(compareLight(lightBy(field, a, points), lightBy(field, b, points))).rms;
}

/// A door on its way, and the masks that follow it.
class Swing {
public:
    Swing(const Context& context, const MaskDesc& desc)
        : m_context(context),
          m_house(context),
          m_rooms(m_house),
          m_field(must(Field::create(context, m_house.desc()))) {
        m_row.masks = desc;
        m_house.turn(1);
        const auto start = Clock::now();
        m_open = fullBake(context, m_house, desc);
        m_row.bakeSeconds = millisecondsSince(start) / 1000;
        m_house.turn(0);
        const std::vector<Bounds> occluders = m_house.occluders();
        MaskDesc first = desc;
        first.occluders = occluders;
        const OrientedBox door = m_house.door();
        m_updater.emplace(
            must(MaskUpdater::create(context, m_house.tracer(), m_house.desc(), first, std::span(&door, 1))));
        m_shut = m_updater->masks();
        use(m_field, m_shut);
        for (int i = 0; i < kFilled; ++i) update();
    }

    DoorRow run() {
        for (int frame = 1; frame <= kFrames; ++frame) step(float(frame) / kFrames);
        while (!m_updater->settled()) {
            ++m_row.behind;
            must(m_updater->update(m_house.tracer(), {.milliseconds = kBudgetMs}));
        }
        compareOpen();
        for (int frame = kFrames - 1; frame >= 0; --frame) step(float(frame) / kFrames);
        while (!m_updater->settled()) must(m_updater->update(m_house.tracer()));
        for (const auto* points : {&m_rooms.atDoor, &m_rooms.elsewhere})
            m_row.shut = std::max(m_row.shut, between(m_field, m_updater->masks(), m_shut, *points));
        m_row.meanMs /= 2 * kFrames;
        return m_row;
    }

private:
    void update() { must(m_field.update(m_house.tracer(), m_house.night())); }

    void step(float open) {
        m_house.turn(open);
        const OrientedBox door = m_house.door();
        const auto start = Clock::now();
        must(m_updater->move(std::span(&door, 1)));
        must(m_updater->update(m_house.tracer(), {.milliseconds = kBudgetMs}));
        const double ms = millisecondsSince(start);
        m_row.meanMs += ms;
        m_row.mostMs = std::max(m_row.mostMs, ms);
        use(m_field, m_updater->masks());
        update();
        if (m_frame++ % kEvery == 0) measureLeak();
    }

    // Light that these probes have and exact visibility of this moment does not show, over the light of the kitchen.
    void measureLeak() {
        const auto exact = fullBake(m_context, m_house, {.clusters = 8});
        const std::vector<double> truth = lightBy(m_field, exact, m_rooms.study);
        const auto kitchen = lightBy(m_field, exact, m_rooms.kitchen);
        double lit = 0;
        for (const double e : kitchen) lit += e / double(kitchen.size());
        const auto leakOf = [&](const std::shared_ptr<const Masks>& masks) {
            const std::vector<double> light = lightBy(m_field, masks, m_rooms.study);
            double more = 0;
            for (std::size_t i = 0; i < light.size(); ++i) more += (light[i] - truth[i]) / double(light.size());
            return std::max(0.0, more) / lit;
        };
        m_row.leak = std::max(m_row.leak, leakOf(m_updater->masks()));
        m_row.stale = std::max(m_row.stale, leakOf(m_open));
        use(m_field, m_updater->masks());
    }

    void compareOpen() {
        MaskDesc other = m_row.masks;
        ++other.seed;
        const auto again = fullBake(m_context, m_house, other);
        m_row.atDoor = between(m_field, m_updater->masks(), m_open, m_rooms.atDoor);
        m_row.elsewhere = between(m_field, m_updater->masks(), m_open, m_rooms.elsewhere);
        m_row.seedAtDoor = between(m_field, again, m_open, m_rooms.atDoor);
        m_row.seedElsewhere = between(m_field, again, m_open, m_rooms.elsewhere);
        use(m_field, m_updater->masks());
    }

    const Context& m_context;
    House m_house;
    Rooms m_rooms;
    Field m_field;
    std::optional<MaskUpdater> m_updater;
    std::shared_ptr<const Masks> m_open, m_shut;
    DoorRow m_row;
    int m_frame = 0;
};

}  // namespace

Result<std::vector<DoorRow>> measureDoors(const Context& context) try {
    std::vector<DoorRow> rows;
    for (const MaskDesc& desc : {MaskDesc{.clusters = 4}, MaskDesc{.clusters = 6, .strict = true}, {.clusters = 8}})
        rows.push_back(Swing(context, desc).run());
    return rows;
} catch (const std::runtime_error& error) {
    return fail(ErrorCode::outOfMemory, error.what());
}

std::string doorTable(const std::vector<DoorRow>& rows) {
    std::string table = fmt::format(
        "\n### A door and its masks\n\n"
        "builtin:house at night with a lamp in the kitchen, 32x16x16 probes, and a door to the study that opens in {0} "
        "frames and shuts in as many. `MaskUpdater` has {1:.0f} ms a frame. Bake: seconds of a full one. Ms: the "
        "updater's, mean and most. Behind: frames after the door has stopped until the masks are those of the open "
        "door. Leak: light in the study that the same probes have not by exact visibility of the moment, over the "
        "kitchen's, worst of every fifth frame; stale: the same, had the masks stayed those of the open door. Open: "
        "RMS from a full bake of the open door, within {2:.0f} m of the door and elsewhere in the two rooms; in "
        "brackets the "
        "same of full bakes with two seeds. Shut: RMS of the door that is shut again from the first masks.\n\n"
        "| clusters | bake | ms | most | behind | leak | stale | open, at the door | open, elsewhere | shut |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        kFrames, kBudgetMs, kNear);
    for (const DoorRow& row : rows)
        table += fmt::format(
            "| {}{} | {:.2f} s | {:.1f} | {:.1f} | {} | {:.3f} % | {:.2f} % | {:.1f} % ({:.1f}) | {:.1f} % ({:.1f}) | "
            "{:.2g} % |\n",
            row.masks.clusters, row.masks.strict ? ", strict" : "", row.bakeSeconds, row.meanMs, row.mostMs, row.behind,
            100 * row.leak, 100 * row.stale, 100 * row.atDoor, 100 * row.seedAtDoor, 100 * row.elsewhere,
            100 * row.seedElsewhere, 100 * row.shut);
    return table;
}

}  // namespace probegi::accuracy
