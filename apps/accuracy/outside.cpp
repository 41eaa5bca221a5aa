#include "outside.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <stdexcept>

namespace probegi::accuracy {

namespace {

constexpr int kPoints = 1500;
constexpr int kPathsPerPoint = 256;
constexpr int kProbes = 1500;
constexpr float kTolerance = 0.02f;  ///< of converge()
constexpr int kMostUpdates = 64;     ///< of converge()

/// The value; throws the error's message, which measureOutside() catches.
template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

VolumeDesc innerVolume(const Bounds& bounds) {
    const glm::vec3 quarter = 0.25f * bounds.size();
    return must(placeVolume({bounds.centre() - quarter, bounds.centre() + quarter},
                            {.targetProbes = kProbes, .marginCells = 0}));
}

/// 0 inside, then up to half a cell, to one and a half, farther.
std::size_t zoneOf(const VolumeDesc& v, glm::vec3 point) {
    const glm::vec3 half = 0.5f * glm::vec3(v.counts - 1);
    const glm::vec3 apart = glm::abs((point - v.origin) / v.spacing - half) - half;
    const float cells = std::max({apart.x, apart.y, apart.z});
    return cells <= 0 ? 0 : cells <= 0.5f ? 1 : cells <= 1.5f ? 2 : 3;
}

struct Assumption {
    const char* name;
    OutsideLight outside;
    glm::vec3 radiance;
};

}  // namespace

Result<std::vector<OutsideResult>> measureOutside(const Context& context, const std::string& name,
                                                  const Scene& scene) try {
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const auto tracer = must(makeEmbreeTracer(context, scene, pose));
    const PathTracer pathTracer = must(PathTracer::create(context, scene, pose, *tracer, lighting));
    const SurfaceTruth truth =
        must(traceSurfaceTruth(pathTracer, must(surfacePoints(scene, pose, *tracer, kPoints)), kPathsPerPoint));
    FieldDesc desc;
    desc.volumes = {innerVolume(pose.bounds)};
    std::vector<Assumption> assumptions{{"nearest", OutsideLight::nearest, glm::vec3(0.0f)},
                                        {"black", OutsideLight::fades, glm::vec3(0.0f)}};
    if (!scene.sky.black() && !scene.sky.textured())
        for (const float share : {0.25f, 0.5f})
            assumptions.push_back(
                {share < 0.3f ? "sky / 4" : "sky / 2", OutsideLight::fades, share * scene.sky.radiance});
    std::vector<OutsideResult> rows;
    for (const Assumption& assumption : assumptions) {
        FieldSettings settings;
        settings.outside = assumption.outside;
        settings.outsideRadiance = assumption.radiance;
        Field field = must(Field::create(context, desc, settings));
        must(field.converge(*tracer, lighting, kTolerance, kMostUpdates));
        const std::vector<double> light = must(lightAt(field, truth.queries));
        OutsideResult row{name, assumption.name, {}};
        for (std::size_t zone = 0; zone < row.error.size(); ++zone) {
            SurfaceTruth part;
            std::vector<double> there;
            for (std::size_t i = 0; i < light.size(); ++i) {
                if (zoneOf(desc.volumes[0], truth.queries[i].position) != zone) continue;
                part.queries.push_back(truth.queries[i]);
                part.truth.push_back(truth.truth[i]);
                part.standardError.push_back(truth.standardError[i]);
                there.push_back(light[i]);
            }
            row.error[zone] = must(compareAtSurfaces(there, part));
        }
        rows.push_back(std::move(row));
    }
    return rows;
} catch (const std::runtime_error& error) {
    return fail(ErrorCode::outOfMemory, error.what());
}

std::string outsideTable(const std::vector<OutsideResult>& rows) {
    std::string table =
        "\n### Outside of all volumes\n\n"
        "A volume of about 1,500 probes over the inner half of each side of a scene, `converge`, irradiance at surface "
        "points of the whole scene over the path tracer's: mean, RMS and 95th percentile, by the distance from the "
        "outermost probes. Outside: the nearest probes' light, or what it fades to.\n\n"
        "| scene | outside | inside | up to 0.5 cells | to 1.5 cells | farther |\n|---|---|---|---|---|---|\n";
    std::string missing;
    for (const OutsideResult& row : rows) {
        if (!row.missing.empty()) {
            missing += fmt::format("\nNot measured: {} ({}).\n", row.scene, row.missing);
            continue;
        }
        table += fmt::format("| {} | {} |", row.scene, row.assumed);
        for (const SurfaceError& e : row.error)
            table += fmt::format(" {:.2f}, {:.0f} %, {:.1f} ({} points) |", e.mean, 100 * e.rms, e.high, e.points);
        table += "\n";
    }
    return table + missing;
}

}  // namespace probegi::accuracy
