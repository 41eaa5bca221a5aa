#include "bake/report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "console/output.h"
#include "field_text.h"
#include "render_stats.h"

namespace probegi::tool {

std::string bakeText(const BakeReport& report, const BakeOptions& options, const LoadedSetup& setup) {
    std::string text =
        fmt::format("baked       {}, {}\nprobes      {} in {} {}, {} rays\nlight       {}{}\n",
                    plainText(options.render.output), sizeText(report.fileBytes), probeCount(setup),
                    setup.volumes.size(), setup.volumes.size() == 1 ? "volume" : "volumes", options.render.rays,
                    describeRun(report.run, options.render.run),
                    report.updatesBefore > 0 ? fmt::format(", after {} before", report.updatesBefore) : "");
    if (report.masks) text += masksText(*report.masks);
    text += fmt::format("seconds     masks {:.2f}", report.maskSeconds);
    if (report.masks && report.maskSeconds > 0)
        text += fmt::format(" (rays {:.2f}, colours {:.2f}, masks {:.2f}, compression {:.2f})",
                            report.masks->visibilitySeconds, report.masks->clusterSeconds, report.masks->maskSeconds,
                            report.masks->compressSeconds);
    return text + fmt::format(", light {:.2f}, file {:.2f}\nmemory      {} of the field, {} in all at most\n",
                              report.lightSeconds, report.fileSeconds, sizeText(report.memory.persistentBytes()),
                              sizeText(peakMemoryBytes()));
}

std::string bakeJson(const BakeReport& report, const BakeOptions& options, const LoadedSetup& setup) {
    const auto& convergence = report.run.convergence;
    nlohmann::ordered_json converged, remaining;  // null
    if (convergence) converged = convergence->converged;
    if (convergence && std::isfinite(convergence->remaining)) remaining = convergence->remaining;
    nlohmann::ordered_json json{
        {"probes", probeCount(setup)},
        {"raysPerProbe", options.render.rays},
        {"updates", report.updates},
        {"updatesBefore", report.updatesBefore},
        {"converged", converged},
        {"remaining", remaining},
        {"seconds", {{"masks", report.maskSeconds}, {"light", report.lightSeconds}, {"file", report.fileSeconds}}},
        {"fileBytes", report.fileBytes},
        {"fieldBytes", report.memory.persistentBytes()}};
    if (report.masks) json["masks"] = masksJson(*report.masks);
    json["peakMemoryBytes"] = peakMemoryBytes();
    return jsonText(json);
}

}  // namespace probegi::tool
