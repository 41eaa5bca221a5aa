#include "markdown.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "console/machine.h"
#include "console/output.h"

namespace probegi::accuracy {

namespace {

constexpr std::string_view kBegin = "<!-- measured: begin -->\n";
constexpr std::string_view kEnd = "<!-- measured: end -->";

std::string differenceRow(const std::string& scene, const char* name, const ImageDifference& d) {
    return fmt::format("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", scene,
                       name, d.rmse, d.relmse, d.scaledRelmse, d.flip, d.ratio.mean, d.ratio.low, d.ratio.median,
                       d.ratio.high);
}

/// `of` and `exact` select the layer to compare.
template <class Of>
std::string differenceTable(const std::vector<MeasuredScene>& scenes, const char* title, const Of& of,
                            ImageDifference tool::RenderedScene::*exact) {
    std::string text = fmt::format(
        "### {}\n\n"
        "| scene | light | RMSE | relMSE | scaled relMSE | FLIP | mean ratio | blocks, 5th percentile | 50th | 95th |\n"
        "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        title);
    for (const auto& [name, scene] : scenes) {
        text += differenceRow(name, "no GI", of(scene.none));
        text += differenceRow("", "leaking field, `converge`", of(scene.leaky));
        text += differenceRow("", "field, `converge`", of(scene.ddgi));
        if (scene.realtime) text += differenceRow("", "field, `update`", of(scene.realtime->method));
        text += differenceRow("", "*an exact picture*", scene.*exact);
    }
    return text + "\n";
}

std::string differenceTables(const std::vector<MeasuredScene>& scenes) {
    if (scenes.empty()) return {};
    const auto whole = [](const tool::MethodResult& method) { return method.whole.difference; };
    const auto indirect = [](const tool::MethodResult& method) { return method.indirectOnly; };
    return differenceTable(scenes, "Distance from the reference, all light", whole, &tool::RenderedScene::noiseFloor) +
           differenceTable(scenes, "Distance from the reference, indirect light", indirect,
                           &tool::RenderedScene::indirectNoiseFloor);
}

std::string convergedText(const tool::FieldRun& run) {
    if (!run.convergence) return "";
    return run.convergence->converged ? "yes" : fmt::format("no: {:.1f} % left", 100 * run.convergence->remaining);
}

std::string ratioRow(const std::string& scene, const char* name, const tool::FieldResult& field, std::size_t probes) {
    return fmt::format("| {} | {} | {} | {} | {:.3f} | {:.3f} | {:.3f} | {} |\n", scene, name, field.run.updates.size(),
                       convergedText(field.run), field.ratio.low, field.ratio.median, field.ratio.high, probes);
}

std::string ratioTable(const std::vector<MeasuredScene>& scenes) {
    if (scenes.empty()) return {};
    std::string text =
        "### Irradiance at the probes, field over reference\n\n"
        "| scene | field | updates | converged | 5th percentile | median | 95th percentile | probes |\n"
        "|---|---|---:|---|---:|---:|---:|---:|\n";
    for (const auto& [name, scene] : scenes) {
        const std::size_t probes = scene.truth.probes.size();
        text += ratioRow(name, "leaking, `converge`", scene.leakyField, probes);
        text += ratioRow("", "with its guard, `converge`", scene.ddgiField, probes);
        if (scene.realtime) text += ratioRow("", "with its guard, `update`", scene.realtime->field, probes);
    }
    return text + "\n";
}

std::string basisTable(const std::vector<MeasuredScene>& scenes) {
    if (scenes.empty()) return {};
    std::string text =
        "### What the numbers rest on\n\n"
        "| scene | probes | samples a pixel | noise of the picture | probes compared | left out: in walls | "
        "left out: dark | noise at a probe |\n|---|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const auto& [name, scene] : scenes)
        text += fmt::format("| {} | {} | {} | {:.1f} % | {} | {} | {} | {:.1f} % |\n", name, probeCount(scene.grid),
                            scene.referenceSamples, 100 * scene.referenceNoise, scene.truth.probes.size(),
                            scene.truth.inWalls, scene.truth.dark, 100 * scene.truth.noise);
    return text + "\n";
}

std::string leakTable(const std::vector<LeakResult>& leaks) {
    if (leaks.empty()) return {};
    std::string text =
        "### Light in the sealed room of `builtin:dark-room`, over that in the sunlit room\n\n"
        "| wall | leaking, mean | leaking, worst | moments, mean | moments, worst | relocated, mean | "
        "relocated, worst | moments, `update`, mean | moments, `update`, worst |\n"
        "|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const LeakResult& leak : leaks)
        text += fmt::format(
            "| {:.0f} cm | {:.2f} % | {:.2f} % | {:.3f} % | {:.3f} % | {:.3f} % | {:.3f} % | {:.3f} % | "
            "{:.3f} % |\n",
            100 * leak.wallThickness, 100 * leak.leaky.mean, 100 * leak.leaky.worst, 100 * leak.moments.mean,
            100 * leak.moments.worst, 100 * leak.relocated.mean, 100 * leak.relocated.worst, 100 * leak.realtime.mean,
            100 * leak.realtime.worst);
    return text;
}

}  // namespace

std::string accuracyTables(const std::vector<MeasuredScene>& scenes, const std::vector<LeakResult>& leaks,
                           int threads) {
    return fmt::format("Measured on {}, {} threads; the numbers do not depend on the machine.\n\n",
                       tool::processorName(), threads) +
           differenceTables(scenes) + ratioTable(scenes) + basisTable(scenes) + leakTable(leaks);
}

Result<void> replaceBetweenMarkers(const std::filesystem::path& path, const std::string& tables) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return fail(ErrorCode::fileUnreadable,
                    fmt::format("'{}' cannot be read: give an existing page with -o", path.string()));
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const std::size_t begin = text.find(kBegin);
    const std::size_t end = text.find(kEnd);
    if (begin == std::string::npos || end == std::string::npos || end < begin)
        return fail(ErrorCode::malformed, fmt::format("'{}' lacks the lines '{}' and '{}' that the tables go between",
                                                      path.string(), kBegin.substr(0, kBegin.size() - 1), kEnd));
    text.replace(begin + kBegin.size(), end - begin - kBegin.size(), tables);
    return tool::writeText(path, text);
}

}  // namespace probegi::accuracy
