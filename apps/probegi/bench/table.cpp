#include "bench/table.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "console/machine.h"
#include "console/output.h"
#include "console/text_table.h"
#include "render_stats.h"

namespace probegi::tool {

namespace {

// Goals: upper (or lower) limits of ratios.
constexpr double kTraceGoal = 1.15, kBlendGoal = 0.25, kUpdateGoal = 3, kQueryGoal = 0.7, kPictureGoal = 10;
constexpr double kBytesGoal = 1600, kScalingGoal = 1.8, kGrowthGoal = 1.1;

// SDFDDGI paper, table 1: 22x14x32 probes on Sponza, 1920x1080. DDGI paper, figure 8: trace and update, no probe
// asleep.
constexpr const char* kPapersUpdate =
    "RTXGI 3.28 ms, SDFDDGI 0.18 ms (RTX 2080 Ti) [1]; DDGI 0.75 to 3.7 ms, four scenes [2]";
constexpr const char* kPapersShading = "RTXGI 0.70 ms, SDFDDGI 0.54 ms + 0.57 ms contact GI, 1920x1080 [1]";
constexpr const char* kPapersFrame = "RTXGI 3.98 ms, SDFDDGI 1.30 ms: update + shading, no primary rays [1]";
constexpr const char* kNotes =
    "Medians of {} interleaved rounds; a ratio is taken within a round, then its median. Floor: rtcIntersect1 in "
    "order, fastest build, no alpha masks, all {:.2f} M rays of an update of {} probes.\n"
    "[1] SDFDDGI paper, table 1 (RTX 2080 Ti, Sponza, the same 22x14x32 probes). [2] DDGI paper, figure 8.\n";

std::string milliseconds(double ms) {
    return fmt::format("{:.4g} ms", ms);
}

std::string rate(double count, double ms) {
    return fmt::format("{}, {:.2f} M rays/s", milliseconds(ms), count / ms * 1e-3);
}

using Round = BenchRound;

BenchRow againstFloor(const BenchResult& r, std::string key, std::string name, double UpdateTimes::*stage,
                      std::optional<double> goal, std::string papers) {
    return {std::move(key),
            std::move(name),
            milliseconds(r.median([=](const Round& x) { return x.update.*stage; })),
            "floor",
            r.median([=](const Round& x) { return x.update.*stage / x.floor; }),
            goal,
            false,
            std::move(papers)};
}

void addUpdateRows(const BenchResult& r, std::vector<BenchRow>& rows) {
    const auto floor = [](const Round& x) { return x.floor; };
    const auto robust = [](const Round& x) { return x.robustFloor; };
    rows.push_back({"floor",
                    fmt::format("floor: raw Embree, {} + {} rays a probe", r.raysPerProbe, r.fixedRays),
                    rate(r.rays(), r.median(floor)),
                    "",
                    {},
                    {},
                    false,
                    ""});
    rows.push_back({"robustFloor",
                    "the same, watertight (ROBUST)",
                    rate(r.rays(), r.median(robust)),
                    "floor",
                    r.median([](const Round& x) { return x.robustFloor / x.floor; }),
                    {},
                    false,
                    ""});
    rows.push_back({"trace", "update: trace", milliseconds(r.median([](const Round& x) { return x.update.trace; })),
                    "watertight floor", r.median([](const Round& x) { return x.update.trace / x.robustFloor; }),
                    kTraceGoal, false, ""});
    rows.push_back(againstFloor(r, "shade", "update: shade", &UpdateTimes::shade, {}, ""));
    rows.push_back(againstFloor(r, "blend", "update: blend", &UpdateTimes::blend, kBlendGoal, ""));
    rows.push_back(againstFloor(r, "update", "update: all", &UpdateTimes::total, kUpdateGoal, kPapersUpdate));
    // Figure 8: the time saved at equal quality, and the rays that would fill it.
    const double left = r.median([](const Round& x) { return x.updateOfActive / x.update.total; });
    rows.push_back(
        {"updateOfActive",
         fmt::format("update of the {:.0f} % of the probes that are awake; as long with {:.0f} more rays each",
                     100.0 * r.activeProbes / r.probes, r.raysPerProbe * (1 / left - 1)),
         milliseconds(r.median([](const Round& x) { return x.updateOfActive; })),
         "update: all",
         left,
         {},
         false,
         "0.5 to 0.7 (Figure 8)"});
}

void addPictureRows(const BenchResult& r, std::vector<BenchRow>& rows) {
    const double perPoint = 1e6 * r.threads / double(std::max<std::size_t>(1, r.points)),
                 perRay = 1e6 * r.threads / r.rays();
    const double query = r.median([](const Round& x) { return x.query; });
    const double doubtful = 1e-4 * r.median([](const Round& x) { return x.fallbacks; }) * perPoint / r.threads;
    rows.push_back({"query", fmt::format("query of the {:.2f} M points of a picture", double(r.points) * 1e-6),
                    fmt::format("{}, {:.0f} ns a point and thread; {:.1f} % ask farther", milliseconds(query),
                                query * perPoint, doubtful),
                    "ray of the floor",
                    r.median([=](const Round& x) { return x.query * perPoint / (x.floor * perRay); }), kQueryGoal,
                    false, kPapersShading});
    rows.push_back({"primaryFloor",
                    "raw Embree, primary rays of a picture",
                    rate(double(r.pixels), r.median([](const Round& x) { return x.primaryFloor; })),
                    "",
                    {},
                    {},
                    false,
                    ""});
    rows.push_back({"picture", "picture: primary, shadows, query",
                    milliseconds(r.median([](const Round& x) { return x.picture; })), "its primary rays",
                    r.median([](const Round& x) { return x.picture / x.primaryFloor; }), kPictureGoal, false,
                    kPapersFrame});
}

BenchRow memoryRow(const BenchResult& r) {
    const double bytes = double(r.persistentBytes) / r.probes;
    return {"memory",
            "memory a probe",
            fmt::format("{:.0f} bytes, and {:.0f} of scratch", bytes, double(r.scratchBytes) / r.probes),
            "",
            bytes,
            kBytesGoal,
            false,
            ""};
}

// Judged only with two threads, which the goal is for, on as many processors.
BenchRow scalingRow(const BenchResult& r) {
    const bool judged = r.threads == 2 && std::thread::hardware_concurrency() >= 2;
    const double alone = r.median([](const Round& x) { return x.updateAlone; });
    return {"scaling",
            fmt::format("update on 1 thread / on {}", r.threads),
            fmt::format("{} alone", milliseconds(alone)),
            "",
            r.median([](const Round& x) { return x.updateAlone / x.update.total; }),
            judged ? std::optional(kScalingGoal) : std::nullopt,
            true,
            ""};
}

double nanosecondsPerRay(const BenchGrowth& g) {
    return median(g.ms) * 1e6 / (double(g.probes) * g.rays);
}

// With more digits than the goals, so that a near miss shows as a miss.
std::string decimal(std::optional<double> value) {
    if (!value) return {};
    return *value >= 100 ? fmt::format("{:.0f}", *value) : fmt::format("{:.3f}", *value);
}

}  // namespace

std::string BenchRow::verdict() const {
    if (!goal || !ratio) return {};
    return (atLeast ? *ratio >= *goal : *ratio <= *goal) ? "pass" : "miss";
}

double growthExponent(const std::vector<BenchGrowth>& growth) {
    if (growth.size() < 2) return 1;
    const BenchGrowth &first = growth.front(), &last = growth.back();
    return std::log(median(last.ms) / median(first.ms)) /
           std::log(double(last.probes) * last.rays / (double(first.probes) * first.rays));
}

std::vector<BenchRow> benchRows(const BenchResult& result) {
    std::vector<BenchRow> rows;
    addUpdateRows(result, rows);
    addPictureRows(result, rows);
    rows.push_back(memoryRow(result));
    if (result.threads > 1) rows.push_back(scalingRow(result));
    if (result.growth.size() > 1)
        rows.push_back({"growth", "growth of an update, exponent", "see below", "", growthExponent(result.growth),
                        kGrowthGoal, false, ""});
    return rows;
}

std::string benchMarkdown(const BenchResult& result, const std::string& sceneName) {
    std::string text = fmt::format("{} ({}), {} threads, {}: {} ({} triangles), {} probes x {} rays\n\n",
                                   processorName(), instructionSet(), result.threads, today(), sceneName,
                                   result.triangles, result.probes, result.raysPerProbe);
    std::vector<std::vector<std::string>> cells{{"measured", "figure", "ratio", "to", "goal", "verdict", "papers"}};
    for (const BenchRow& row : benchRows(result))
        cells.push_back({row.name, row.figure, decimal(row.ratio), row.against,
                         row.goal ? fmt::format("{} {:g}", row.atLeast ? ">=" : "<=", *row.goal) : std::string(),
                         row.verdict(), row.papers});
    text += markdownTable(cells) + "\n" +
            fmt::format(fmt::runtime(kNotes), result.rounds.size(), result.rays() * 1e-6, result.probes);
    if (result.growth.empty()) return text;
    cells = {{"probes", "rays a probe", "update", "ns a probe and ray"}};
    for (const BenchGrowth& g : result.growth)
        cells.push_back({std::to_string(g.probes), std::to_string(g.rays), milliseconds(median(g.ms)),
                         fmt::format("{:.0f}", nanosecondsPerRay(g))});
    return text + "\n" + markdownTable(cells);
}

std::string benchJson(const BenchResult& result, const std::string& sceneName) {
    nlohmann::ordered_json json{{"processor", processorName()},
                                {"instructions", std::string(instructionSet())},
                                {"date", today()},
                                {"scene", sceneName},
                                {"triangles", result.triangles},
                                {"threads", result.threads},
                                {"probes", result.probes},
                                {"raysPerProbe", result.raysPerProbe},
                                {"rounds", result.rounds.size()}};
    for (const BenchRow& row : benchRows(result)) {
        nlohmann::ordered_json entry{{"name", row.name}, {"figure", row.figure}};
        if (row.ratio) entry["ratio"] = *row.ratio;
        if (row.goal) entry["goal"] = *row.goal;
        if (row.goal) entry["pass"] = row.verdict() == "pass";
        if (!row.papers.empty()) entry["papers"] = row.papers;
        json["rows"][row.key] = std::move(entry);
    }
    json["growth"] = nlohmann::ordered_json::array();
    for (const BenchGrowth& g : result.growth)
        json["growth"].push_back({{"probes", g.probes}, {"raysPerProbe", g.rays}, {"ms", median(g.ms)}});
    return jsonText(json);
}

}  // namespace probegi::tool
