#include "surfaces.h"

#include <fmt/format.h>

#include <utility>

namespace probegi::accuracy {

namespace {

constexpr int kPoints = 1500;
constexpr int kPathsPerPoint = 1024;
constexpr float kTolerance = 0.01f;  ///< of converge()
constexpr int kMostUpdates = 128;    ///< of converge()
constexpr int kPlainUpdates = 300;

}  // namespace

Result<SurfaceTruth> surfaceTruth(const Context& context, const tool::LoadedSetup& setup, const Tracer& tracer,
                                  int count, int pathsPerPoint) {
    auto points = surfacePoints(*setup.scene, setup.pose, tracer, count);
    if (!points) return points.error();
    const auto pathTracer = PathTracer::create(context, *setup.scene, setup.pose, tracer, setup.lighting);
    if (!pathTracer) return pathTracer.error();
    return traceSurfaceTruth(*pathTracer, std::move(*points), pathsPerPoint);
}

Result<std::vector<SurfaceRow>> measureSurface(const Context& context, const std::string& name,
                                               const tool::LoadedSetup& setup, bool updatesToo) {
    const auto tracer = makeEmbreeTracer(context, *setup.scene, setup.pose);
    if (!tracer) return tracer.error();
    const auto truth = surfaceTruth(context, setup, **tracer, kPoints, kPathsPerPoint);
    if (!truth) return truth.error();
    std::vector<SurfaceRow> rows;
    for (const bool plain : {false, true}) {
        if (plain && !updatesToo) break;
        FieldDesc desc;
        desc.volumes = setup.volumes;
        auto field = Field::create(context, desc);
        if (!field) return field.error();
        if (!plain) {
            const auto done = field->converge(**tracer, setup.lighting, kTolerance, kMostUpdates);
            if (!done) return done.error();
        }
        for (int i = 0; plain && i < kPlainUpdates; ++i)
            if (const auto done = field->update(**tracer, setup.lighting); !done) return done.error();
        const auto error = compareAtSurfaces(*field, *truth);
        if (!error) return error.error();
        rows.push_back({name, probeCount(setup), plain ? "300 updates" : "converge", *error});
    }
    return rows;
}

std::string surfaceTable(const std::vector<SurfaceRow>& rows) {
    if (rows.empty()) return {};
    std::string text =
        "\n### Irradiance at surfaces, field over reference\n\n"
        "| scene | probes | field by | mean | RMS | 5th percentile | median | 95th percentile | points |\n"
        "|---|---:|---|---:|---:|---:|---:|---:|---:|\n";
    for (const SurfaceRow& row : rows) {
        const SurfaceError& e = row.error;
        text += fmt::format("| {} | {} | {} | {:+.1f} % | {:.1f} % | {:.3f} | {:.3f} | {:.3f} | {} |\n", row.scene,
                            row.probes, row.run, 100 * (e.mean - 1), 100 * e.rms, e.low, e.median, e.high, e.points);
    }
    return text;
}

}  // namespace probegi::accuracy
