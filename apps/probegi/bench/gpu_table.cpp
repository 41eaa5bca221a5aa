#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "bench/gpu.h"
#include "console/output.h"
#include "console/text_table.h"

namespace probegi::tool {

namespace {

// Goals in milliseconds for a data-centre GPU of about 60 TFLOP/s without ray-tracing cores, for 22x14x32 probes of 144
// rays and 1920x1080 points.
constexpr double kBlendGoal = 0.05, kUpdateGoal = 1.5, kQueryGoal = 0.15;

// SDFDDGI paper, table 1: RTX 2080 Ti, Sponza, the same volume and picture.
constexpr const char* kPapersUpdate = "RTXGI 3.28 ms, SDFDDGI 0.18 ms [1]";
constexpr const char* kPapersQuery = "RTXGI 0.70 ms, SDFDDGI 0.54 ms + 0.57 ms contact GI [1]";
constexpr const char* kNotes =
    "Medians of {} rounds. Passes by the device's own clock; wall clock: recording, submission and waiting as well, "
    "and "
    "for queries the transfer of points and answers. Memory: {:.0f} bytes a probe, and {:.0f} of scratch.\n"
    "[1] SDFDDGI paper, table 1 (RTX 2080 Ti, Sponza, 22x14x32 probes, 1920x1080).\n";

struct GpuBenchRow {
    std::string key, name;
    double ms = 0;
    std::optional<double> goal{};
    std::string papers{};
};

bool isQuery(const std::string& pass) {
    return pass == "query";
}

// The weights of its matrix product count as part of the blend.
bool isBlend(const std::string& pass) {
    return pass == "weights" || pass.starts_with("blend");
}

// A row per pass, then the sums that have goals. Devices without timestamps have neither.
void addPassRows(const GpuBenchResult& r, std::vector<GpuBenchRow>& rows) {
    if (r.rounds.empty() || r.rounds.front().passes.empty()) return;
    const auto sum = [&](const std::function<bool(const std::string&)>& chosen) {
        return r.median([&](const GpuBenchRound& round) { return round.sum(chosen); });
    };
    for (const auto& [pass, ms] : r.rounds.front().passes) {
        const std::string name = pass;
        if (isQuery(name)) continue;
        rows.push_back({name, "update: " + name, sum([&](const std::string& other) { return other == name; })});
    }
    const std::optional<double> updateGoal = r.tracer == "BVH" ? std::optional(kUpdateGoal) : std::nullopt;
    rows.push_back({"blend", "update: weights and blends", sum(isBlend), kBlendGoal, ""});
    rows.push_back({"update", "update: all passes", sum([](const std::string& pass) { return !isQuery(pass); }),
                    updateGoal, kPapersUpdate});
    rows.push_back({"query", fmt::format("query of the {:.2f} M points of a picture", double(r.points) * 1e-6),
                    sum(isQuery), kQueryGoal, kPapersQuery});
}

std::vector<GpuBenchRow> gpuBenchRows(const GpuBenchResult& r) {
    std::vector<GpuBenchRow> rows;
    addPassRows(r, rows);
    rows.push_back(
        {"updateWall", "update, wall clock", r.median([](const GpuBenchRound& round) { return round.update; })});
    rows.push_back(
        {"queryWall", "query, wall clock", r.median([](const GpuBenchRound& round) { return round.query; })});
    rows.push_back({"pictureWall", fmt::format("picture of {}x{}, wall clock", r.width, r.height),
                    r.median([](const GpuBenchRound& round) { return round.picture; })});
    return rows;
}

// The goals are for GPUs: software devices get no verdict.
std::string verdict(const GpuBenchResult& result, const GpuBenchRow& row) {
    if (!row.goal || result.type == "software") return {};
    return row.ms <= *row.goal ? "pass" : "miss";
}

}  // namespace

std::string gpuBenchMarkdown(const GpuBenchResult& result, const std::string& sceneName) {
    std::string text = fmt::format("{} ({}, {}, Vulkan {}), {}, {}: {} ({} triangles), {} probes x {} rays\n\n",
                                   result.device, result.type, result.driver, result.api, result.tracer, today(),
                                   sceneName, result.triangles, result.probes, result.raysPerProbe);
    std::vector<std::vector<std::string>> cells{{"measured", "ms", "goal", "verdict", "papers"}};
    for (const GpuBenchRow& row : gpuBenchRows(result))
        cells.push_back({row.name, fmt::format("{:.4g}", row.ms),
                         row.goal ? fmt::format("<= {:g}", *row.goal) : std::string(), verdict(result, row),
                         row.papers});
    return text + markdownTable(cells) + "\n" +
           fmt::format(fmt::runtime(kNotes), result.rounds.size(), double(result.persistentBytes) / result.probes,
                       double(result.scratchBytes) / result.probes);
}

std::string gpuBenchJson(const GpuBenchResult& result, const std::string& sceneName) {
    nlohmann::ordered_json json{{"device", result.device},
                                {"type", result.type},
                                {"driver", result.driver},
                                {"vulkan", result.api},
                                {"tracer", result.tracer},
                                {"date", today()},
                                {"scene", sceneName},
                                {"triangles", result.triangles},
                                {"probes", result.probes},
                                {"raysPerProbe", result.raysPerProbe},
                                {"width", result.width},
                                {"height", result.height},
                                {"points", result.points},
                                {"persistentBytes", result.persistentBytes},
                                {"scratchBytes", result.scratchBytes},
                                {"rounds", result.rounds.size()}};
    for (const GpuBenchRow& row : gpuBenchRows(result)) {
        nlohmann::ordered_json entry{{"name", row.name}, {"ms", row.ms}};
        if (row.goal) entry["goal"] = *row.goal;
        if (const std::string judged = verdict(result, row); !judged.empty()) entry["pass"] = judged == "pass";
        json["rows"][row.key] = std::move(entry);
    }
    return jsonText(json);
}

}  // namespace probegi::tool
