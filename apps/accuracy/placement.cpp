#include "placement.h"

#include <fmt/format.h>

#include <algorithm>

#include "surfaces.h"

namespace probegi::accuracy {

namespace {

constexpr int kPoints = 1500;
constexpr int kPathsPerPoint = 512;
// As many updates for every variant: fewer or more would differ by their noise.
constexpr float kNoTolerance = 1e-9f;
constexpr int kUpdates = 64;
constexpr int kTimedRounds = 9;

struct Variant {
    const char* name;
    bool relocation, states;
};
constexpr Variant kVariants[] = {
    {"lattice", false, false}, {"states", false, true}, {"relocation", true, false}, {"both", true, true}};

/// Each field's time for an update over the first one's: fields take turns, so that whatever else the machine does
/// meets all of them; median over the rounds.
Result<std::vector<double>> timeUpdates(std::span<Field> fields, const Tracer& tracer, const Lighting& lighting) {
    std::vector<std::vector<double>> ratios(fields.size());
    for (int round = 0; round < kTimedRounds; ++round) {
        double first = 0;
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const auto done = fields[i].update(tracer, lighting);
            if (!done) return done.error();
            if (i == 0) first = done->total;
            ratios[i].push_back(done->total / first);
        }
    }
    std::vector<double> medians;
    for (std::vector<double>& r : ratios) {
        std::nth_element(r.begin(), r.begin() + kTimedRounds / 2, r.end());
        medians.push_back(r[kTimedRounds / 2]);
    }
    return medians;
}

Result<double> shareInside(const Field& field) {
    const auto snapshot = field.read();
    if (!snapshot) return snapshot.error();
    const auto inside = std::count_if(snapshot->states.begin(), snapshot->states.end(), [](const ProbeState& state) {
        return state.activity() == ProbeActivity::off || (state.backfaceShare > 0.3f && state.backfaceShare <= 1.0f);
    });
    return double(inside) / double(snapshot->states.size());
}

}  // namespace

Result<std::vector<PlacementRow>> measurePlacement(const Context& context, const std::string& name,
                                                   const tool::LoadedSetup& setup, LeakGuard guard) {
    const auto tracer = makeEmbreeTracer(context, *setup.scene, setup.pose);
    if (!tracer) return tracer.error();
    const auto truth = surfaceTruth(context, setup, **tracer, kPoints, kPathsPerPoint);
    if (!truth) return truth.error();
    std::vector<PlacementRow> rows;
    std::vector<double> without;  // states
    std::vector<Field> fields;
    for (const Variant& variant : kVariants) {
        FieldDesc desc;
        desc.volumes = {setup.grid};
        desc.relocation = variant.relocation;
        desc.probeStates = variant.states;
        FieldSettings settings;
        settings.guard = guard;
        auto field = Field::create(context, desc, settings);
        if (!field) return field.error();
        const auto done = field->converge(**tracer, setup.lighting, kNoTolerance, kUpdates);
        if (!done) return done.error();
        PlacementRow row{name, probeCount(setup.grid), variant.name, 0, 0, 0, 0, {}};
        row.active = double(field->control().tasks().size()) / row.probes;
        const auto error = compareAtSurfaces(*field, *truth);
        if (!error) return error.error();
        row.error = *error;
        const auto light = lightAt(*field, truth->queries);
        if (!light) return light.error();
        if (!variant.states) {
            without = *light;
        } else if (const auto difference = compareLight(*light, without); difference) {
            row.difference = difference->rms;
        }
        const auto inside = shareInside(*field);
        if (!inside) return inside.error();
        row.inside = *inside;
        fields.push_back(std::move(*field));
        rows.push_back(std::move(row));
    }
    const auto times = timeUpdates(fields, **tracer, setup.lighting);
    if (!times) return times.error();
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].time = (*times)[i];
    return rows;
}

std::string placementTable(const std::vector<PlacementRow>& rows) {
    if (rows.empty()) return {};
    std::string text =
        "\n### Relocation and probe states, on automatic grids\n\n"
        "| scene | probes | placement | in walls | updated | update | mean | RMS | 5th percentile | median | 95th "
        "percentile | against all awake |\n"
        "|---|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const PlacementRow& row : rows)
        text += fmt::format(
            "| {} | {} | {} | {:.1f} % | {:.1f} % | {:.2f} | {:+.1f} % | {:.1f} % | {:.3f} | {:.3f} | {:.3f} | {:.2f} "
            "% |\n",
            row.scene, row.probes, row.placement, 100 * row.inside, 100 * row.active, row.time,
            100 * (row.error.mean - 1), 100 * row.error.rms, row.error.low, row.error.median, row.error.high,
            100 * row.difference);
    return text;
}

}  // namespace probegi::accuracy
