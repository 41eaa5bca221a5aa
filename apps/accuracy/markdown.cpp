#include "markdown.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "machine.h"
#include "output.h"

namespace probegi::accuracy {

namespace {

constexpr std::string_view kBegin = "<!-- measured: begin -->\n";
constexpr std::string_view kEnd = "<!-- measured: end -->";

std::string methodRow(const std::string& scene, const char* name, const tool::MethodResult& m) {
    const ImageDifference& w = m.whole.difference;
    const ImageDifference& i = m.indirectOnly;
    return fmt::format("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} |\n", scene, name, w.rmse,
                       w.relmse, w.flip, i.rmse, i.relmse, i.flip);
}

std::string differenceTable(const std::vector<MeasuredScene>& scenes) {
    std::string text =
        "### Distance from the reference\n\n"
        "| scene | light | RMSE | relMSE | FLIP | RMSE, indirect | relMSE, indirect | FLIP, indirect |\n"
        "|---|---|---:|---:|---:|---:|---:|---:|\n";
    for (const auto& [name, scene] : scenes) {
        text += methodRow(name, "no GI", scene.none);
        text += methodRow("", "leaking field", scene.leaky);
        text += methodRow("", "field", scene.ddgi);
        const ImageDifference& floor = scene.noiseFloor;
        text += fmt::format("| | *an exact picture* | {:.4f} | {:.4f} | {:.4f} | | | |\n", floor.rmse, floor.relmse,
                            floor.flip);
    }
    return text + "\n";
}

std::string ratioRow(const std::string& scene, const char* name, const tool::Percentiles& p) {
    return fmt::format("| {} | {} | {:.3f} | {:.3f} | {:.3f} |\n", scene, name, p.low, p.median, p.high);
}

std::string ratioTable(const std::vector<MeasuredScene>& scenes) {
    std::string text =
        "### Irradiance at the probes, field over reference\n\n"
        "| scene | field | 5th percentile | median | 95th percentile |\n|---|---|---:|---:|---:|\n";
    for (const auto& [name, scene] : scenes) {
        text += ratioRow(name, "leaking", scene.leakyField.ratio);
        text += ratioRow("", "with its guard", scene.ddgiField.ratio);
    }
    return text + "\n";
}

std::string basisTable(const std::vector<MeasuredScene>& scenes) {
    std::string text =
        "### What the numbers rest on\n\n"
        "| scene | probes | updates | samples a pixel | noise of the picture | probes compared | left out: in walls | "
        "left out: dark | noise at a probe |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const auto& [name, scene] : scenes)
        text +=
            fmt::format("| {} | {} | {} | {} | {:.1f} % | {} | {} | {} | {:.1f} % |\n", name, probeCount(scene.grid),
                        scene.ddgiField.updates, scene.referenceSamples, 100 * scene.referenceNoise,
                        scene.truth.probes.size(), scene.truth.inWalls, scene.truth.dark, 100 * scene.truth.noise);
    return text + "\n";
}

std::string leakTable(const std::vector<LeakResult>& leaks) {
    std::string text =
        "### Light in the sealed room of `builtin:dark-room`, over that in the sunlit room\n\n"
        "| wall | leaking, mean | leaking, worst | moments, mean | moments, worst |\n|---:|---:|---:|---:|---:|\n";
    for (const LeakResult& leak : leaks)
        text += fmt::format("| {:.0f} cm | {:.2f} % | {:.2f} % | {:.3f} % | {:.3f} % |\n", 100 * leak.wallThickness,
                            100 * leak.leaky.mean, 100 * leak.leaky.worst, 100 * leak.moments.mean,
                            100 * leak.moments.worst);
    return text;
}

}  // namespace

std::string accuracyTables(const std::vector<MeasuredScene>& scenes, const std::vector<LeakResult>& leaks,
                           int threads) {
    return fmt::format("Measured on {}, {} threads; the numbers do not depend on the machine.\n\n",
                       tool::processorName(), threads) +
           differenceTable(scenes) + ratioTable(scenes) + basisTable(scenes) + leakTable(leaks);
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
