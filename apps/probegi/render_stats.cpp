#include "render_stats.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "console/output.h"
#include "sdf_scene.h"

namespace probegi::tool {

nlohmann::ordered_json masksJson(const MaskReport& report) {
    nlohmann::ordered_json json;
    // Files keep no times.
    if (report.visibilitySeconds + report.clusterSeconds + report.maskSeconds + report.compressSeconds > 0)
        json["seconds"] = {{"visibility", report.visibilitySeconds},
                           {"clusters", report.clusterSeconds},
                           {"masks", report.maskSeconds},
                           {"compression", report.compressSeconds}};
    json.update({{"rays", report.rays},
                 {"cells", report.cells},
                 {"blockedCells", report.blocked},
                 {"cubes", report.cubes},
                 {"denseBytes", report.denseBytes},
                 {"bytes", report.bytes},
                 {"startLoss", report.startLoss},
                 {"loss", report.loss},
                 {"residual", report.residual},
                 {"meanClusters", report.meanClusters},
                 {"blindTexels", report.blindTexels}});
    return json;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

UpdateTimes medianTimes(const std::vector<UpdateTimes>& updates) {
    const auto of = [&](double UpdateTimes::*stage) {
        std::vector<double> values;
        for (const UpdateTimes& times : updates) values.push_back(times.*stage);
        return median(std::move(values));
    };
    return {of(&UpdateTimes::trace), of(&UpdateTimes::shade), of(&UpdateTimes::blend), of(&UpdateTimes::total)};
}

std::string statsJson(const RenderStats& stats) {
    const UpdateTimes ms = medianTimes(stats.run.updates);
    const auto& convergence = stats.run.convergence;
    nlohmann::ordered_json converged, remaining;  // null
    if (convergence) converged = convergence->converged;
    if (convergence && std::isfinite(convergence->remaining)) remaining = convergence->remaining;
    nlohmann::ordered_json json{
        {"probes", stats.probes},
        {"activeProbes", stats.active},
        {"raysPerProbe", stats.raysPerProbe},
        {"frames", stats.run.updates.size()},
        {"updatedProbes", mean(stats.run.updated)},
        {"converged", converged},
        {"remaining", remaining},
        {"updateMs", {{"trace", ms.trace}, {"shade", ms.shade}, {"blend", ms.blend}, {"total", ms.total}}},
        {"pictureMs", stats.pictureMs}};
    if (stats.masks) json["masks"] = masksJson(*stats.masks);
    if (stats.glossyMs) json["glossyMs"] = *stats.glossyMs;
    if (stats.contactMs) json["contactMs"] = *stats.contactMs;
    if (stats.sdf) {
        json["primitives"] = stats.sdf->primitives.size();
        json["primitiveBytes"] = sdfBytes(*stats.sdf);
    }
    json["peakMemoryBytes"] = peakMemoryBytes();
    return jsonText(json);
}

}  // namespace probegi::tool
