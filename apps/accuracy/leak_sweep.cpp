#include "leak_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "console/text_table.h"
#include "leak.h"
#include "probegi/builtin_scenes.h"
#include "probegi/measure.h"

namespace probegi::accuracy {

namespace {

// The rooms of builtin:dark-room: each 5 x 2.8 x 5 m, on either side of a wall centred on x = 0.
constexpr glm::vec3 kRoom(5.0f, 2.8f, 5.0f);
constexpr int kPointsPerSide = 16;
constexpr int kUpdates = 24;        // of converge()
constexpr double kLeaks = 0.01;     // measured share from which the room leaks
constexpr float kPlacement = 0.3f;  // of a cell by which the wall is off a layer of probes
constexpr float kOnWall = 1e-3f;    // metres

struct DarkRoom {
    Scene scene;
    ScenePose pose;
    Bounds sealed, lit;
};

Result<DarkRoom> makeRoom(float wall) {
    BuiltinParams params;
    params.wallThickness = wall;
    auto scene = makeBuiltinScene("dark-room", params);
    if (!scene) return scene.error();
    const glm::vec3 sealed(0.5f * wall, 0, -0.5f * kRoom.z), lit(-0.5f * wall - kRoom.x, 0, -0.5f * kRoom.z);
    DarkRoom room{std::move(*scene), {}, {sealed, sealed + kRoom}, {lit, lit + kRoom}};
    room.pose = poseAt(room.scene);
    return room;
}

/// Probes a cell beyond the building on every side.
VolumeDesc gridOf(const DarkRoom& room, float wall, float spacing) {
    const glm::vec3 lower = room.lit.lower - glm::vec3(wall + spacing),
                    upper = room.sealed.upper + glm::vec3(wall + spacing);
    VolumeDesc grid;
    grid.spacing = glm::vec3(spacing);
    for (int axis = 0; axis < 3; ++axis) {
        // From the wall's middle (x = 0), the floor and the rooms' middle outwards.
        const float first = std::floor(lower[axis] / spacing) - kPlacement;
        grid.origin[axis] = first * spacing;
        grid.counts[axis] = int(std::ceil((upper[axis] - grid.origin[axis]) / spacing)) + 1;
    }
    return grid;
}

Result<double> leakOf(const Field& field, const DarkRoom& room) {
    return leakShare(field, wallPoints(room.sealed, kPointsPerSide), wallPoints(room.lit, kPointsPerSide));
}

/// Places on the room's own six sides, which is where leakShare() looks.
bool isOnSide(const Bounds& room, glm::vec3 p) {
    bool side = false;
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] < room.lower[axis] - kOnWall || p[axis] > room.upper[axis] + kOnWall) return false;
        side |= std::abs(p[axis] - room.lower[axis]) < kOnWall || std::abs(p[axis] - room.upper[axis]) < kOnWall;
    }
    return side;
}

Result<void> auditRow(const Context& context, const DarkRoom& room, const Tracer& tracer, const Field& field,
                      const PathTracer& truth, SweepRow& row) {
    AuditDesc desc;
    desc.truth = &truth;
    desc.truthSamples = 64;
    const auto audit = auditLeaks(context, room.scene, room.pose, tracer, field, desc);
    if (!audit) return audit.error();
    for (const LeakPlace& place : audit->places) {
        if (!isOnSide(room.sealed, place.position) || !(place.leak > 0)) continue;
        ++row.places;
        row.worst = std::max(row.worst, place.leak);
        row.leaked += place.area * (place.light - std::max(place.truth, 0.0));
    }
    return {};
}

Result<SweepRow> measureRow(const Context& context, const DarkRoom& room, const Tracer& tracer, SweepRow row,
                            bool updated) {
    const Lighting lighting{room.pose.lights, room.scene.sky};
    const auto truth = PathTracer::create(context, room.scene, room.pose, tracer, lighting);
    if (!truth) return truth.error();
    FieldDesc desc;
    desc.volumes = {gridOf(room, row.wall, row.spacing)};
    row.probes = probeCount(desc);
    FieldSettings settings;
    settings.guard = row.guard;
    auto field = Field::create(context, desc, settings);
    if (!field) return field.error();
    if (const auto done = field->converge(tracer, lighting, 1e-6f, kUpdates); !done) return done.error();
    const auto converged = leakOf(*field, room);
    if (!converged) return converged.error();
    row.converged = *converged;
    if (const auto audited = auditRow(context, room, tracer, *field, *truth, row); !audited) return audited.error();
    if (!updated) return row;
    auto fresh = Field::create(context, desc, settings);
    if (!fresh) return fresh.error();
    for (int i = 0; i < kRealtimeUpdates; ++i)
        if (const auto done = fresh->update(tracer, lighting); !done) return done.error();
    const auto after = leakOf(*fresh, room);
    if (!after) return after.error();
    row.updated = *after;
    return row;
}

/// Places in ascending order; equal values share the mean of theirs.
std::vector<double> ranks(const std::vector<double>& values) {
    std::vector<double> rank;
    for (const double v : values) {
        const auto below = std::count_if(values.begin(), values.end(), [&](double w) { return w < v; });
        const auto same = std::count(values.begin(), values.end(), v);
        rank.push_back(double(below) + 0.5 * double(same - 1));
    }
    return rank;
}

/// Spearman's: the correlation of the ranks.
double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b) {
    const std::vector<double> x = ranks(a), y = ranks(b);
    const double middle = 0.5 * double(a.size() - 1);
    double xy = 0, xx = 0, yy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - middle) * (y[i] - middle);
        xx += (x[i] - middle) * (x[i] - middle), yy += (y[i] - middle) * (y[i] - middle);
    }
    return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

std::string share(double value) {
    return value < 0 ? "" : fmt::format("{:.3f} %", 100 * value);
}

std::string verdicts(const std::vector<SweepRow>& rows) {
    int both = 0, missed = 0, falseAlarms = 0, neither = 0;
    std::vector<double> measured, leaked;
    for (const SweepRow& row : rows) {
        const bool leaks = row.converged > kLeaks, found = row.places > 0;
        both += leaks && found, missed += leaks && !found, falseAlarms += !leaks && found, neither += !leaks && !found;
        measured.push_back(row.converged), leaked.push_back(row.leaked);
    }
    return fmt::format(
        "\nOf the {} rows, {} leak more than {:.0f} % and the audit finds places in the dark room, {} leak more and it "
        "finds none, {} leak less and it finds some, {} leak less and it finds none. Rank correlation between the "
        "converged leak and the light that the audit's places leak: {:.2f}.\n",
        rows.size(), both, 100 * kLeaks, missed, falseAlarms, neither, rankCorrelation(measured, leaked));
}

}  // namespace

Result<std::vector<SweepRow>> sweepLeaks(const Context& context, const SweepDesc& desc) {
    std::vector<SweepRow> rows;
    for (const float wall : desc.walls) {
        const auto room = makeRoom(wall);
        if (!room) return room.error();
        const auto tracer = makeEmbreeTracer(context, room->scene, room->pose);
        if (!tracer) return tracer.error();
        for (const float spacing : desc.spacings)
            for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
                SweepRow row;
                row.wall = wall, row.spacing = spacing, row.guard = guard;
                const auto measured = measureRow(context, *room, **tracer, row, spacing >= desc.finestUpdated);
                if (!measured) return measured.error();
                rows.push_back(*measured);
            }
    }
    return rows;
}

std::string sweepTables(const std::vector<SweepRow>& rows) {
    if (rows.empty()) return {};
    std::vector<std::vector<std::string>> cells{{"wall", "probes apart", "probes", "guard", "converge", "update",
                                                 "audit: places", "audit: worst", "audit: leaked"}};
    for (const SweepRow& row : rows)
        cells.push_back({fmt::format("{:.0f} cm", 100 * row.wall), fmt::format("{:g} m", row.spacing),
                         std::to_string(row.probes), row.guard == LeakGuard::none ? "none" : "moments",
                         share(row.converged), share(row.updated), std::to_string(row.places),
                         fmt::format("{:.0f} %", 100 * row.worst), fmt::format("{:.3f} W", row.leaked)});
    return "\n### Walls and distances between probes\n\nLight in the sealed room of `builtin:dark-room` over that in "
           "the sunlit one, on one grid a row, and what `auditLeaks` finds on the sealed room's own walls in the "
           "converged field: places, the largest mean leak of one, and the light that they leak.\n\n" +
           tool::markdownTable(cells) + verdicts(rows);
}

}  // namespace probegi::accuracy
