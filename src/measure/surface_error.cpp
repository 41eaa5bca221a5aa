#include <algorithm>
#include <cmath>
#include <utility>

#include "measure/input_checks.h"
#include "measure/luminance.h"
#include "probegi/measure.h"

namespace probegi {

namespace {

constexpr double kHiddenShare = 0.01;  ///< of the mean light, below which nobody sees the place: hulls, insides
constexpr double kDarkShare = 0.1;     ///< of the mean light, below which a ratio is left out

SurfaceError errorOf(std::span<const double> field, const SurfaceTruth& points) {
    double all = 0;
    for (const double light : points.truth) all += light / double(std::max<std::size_t>(1, field.size()));
    double light = 0, truth = 0, squares = 0;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
        if (points.truth[i] <= kHiddenShare * all) continue;
        ++seen;
        light += field[i];
        truth += points.truth[i];
        squares += std::pow(field[i] - points.truth[i], 2) - std::pow(points.standardError[i], 2);
    }
    const double mean = truth / double(std::max<std::size_t>(1, seen));
    std::vector<double> ratios;
    for (std::size_t i = 0; i < field.size(); ++i)
        if (points.truth[i] > kDarkShare * mean) ratios.push_back(field[i] / points.truth[i]);
    const Percentiles p = percentiles(std::move(ratios));
    SurfaceError error;
    error.mean = truth > 0 ? light / truth : 0;
    error.rms = mean > 0 ? std::sqrt(std::max(0.0, squares / double(std::max<std::size_t>(1, seen)))) / mean : 0;
    error.low = p.low;
    error.median = p.median;
    error.high = p.high;
    error.points = seen;
    return error;
}

}  // namespace

Result<SurfaceTruth> traceSurfaceTruth(const PathTracer& pathTracer, std::vector<FieldQuery> points, int samples) {
    return withinMemory("trace the truth at surfaces", [&]() -> Result<SurfaceTruth> {
        SurfaceTruth found{std::move(points), {}, {}};
        const auto truth = pathTracer.irradiance(found.queries, samples);
        if (!truth) return truth.error();
        for (const ReferenceIrradiance& e : *truth) {
            found.truth.push_back(luminance(e.mean));
            found.standardError.push_back(luminance(e.standardError));
        }
        return found;
    });
}

Result<SurfaceError> compareAtSurfaces(std::span<const double> field, const SurfaceTruth& truth) {
    if (auto ok = checkSameCount("luminance", field.size(), truth.truth.size()); !ok) return ok.error();
    if (auto ok = checkSameCount("standardError", truth.standardError.size(), truth.truth.size()); !ok)
        return ok.error();
    return withinMemory("compare light at surfaces", [&]() -> Result<SurfaceError> { return errorOf(field, truth); });
}

Result<SurfaceError> compareAtSurfaces(const Field& field, const SurfaceTruth& truth) {
    return withinMemory("compare light at surfaces", [&]() -> Result<SurfaceError> {
        std::vector<glm::vec3> answers(truth.queries.size());
        if (const auto asked = field.irradiance(truth.queries, answers); !asked) return asked.error();
        std::vector<double> light;
        for (const glm::vec3& e : answers) light.push_back(luminance(e));
        return compareAtSurfaces(light, truth);
    });
}

}  // namespace probegi
