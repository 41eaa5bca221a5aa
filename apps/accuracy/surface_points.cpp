#include "surface_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <random>

#include "probe_ratio.h"

namespace probegi::accuracy {

namespace {

constexpr int kPoints = 1500;
constexpr int kPathsPerPoint = 1024;
constexpr int kOpenRays = 32;          ///< that decide on which side of a surface the open lies
constexpr double kInMatter = 0.25;     ///< of the hits are backfaces: the point looks at the inside of matter
constexpr double kHiddenShare = 0.01;  ///< of the mean light, below which nobody sees the place: hulls, insides
constexpr double kDarkShare = 0.1;     ///< of the mean light, below which a ratio is left out
constexpr float kTolerance = 0.01f;    ///< of converge()
constexpr int kMostUpdates = 128;      ///< of converge()
constexpr int kPlainUpdates = 300;

double luminance(glm::vec3 rgb) {
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

/// Uniform numbers in 0..1 that are the same with every standard library.
class Uniform {
public:
    float operator()() { return float(m_bits() >> 8) * (1.0f / 16777216.0f); }

private:
    std::mt19937 m_bits{20240501};
};

struct Triangle {
    std::array<glm::vec3, 3> corners;
    bool doubleSided = false;
};

/// All triangles in the world, and the running sum of their areas.
struct Triangles {
    std::vector<Triangle> list;
    std::vector<double> areaSum;
};

Triangles worldTriangles(const Scene& scene, const ScenePose& pose) {
    Triangles all;
    double sum = 0;
    for (const Instance& instance : pose.instances)
        for (const Primitive& p : scene.meshes[std::size_t(instance.mesh)].primitives)
            for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
                Triangle t;
                for (std::size_t c = 0; c < 3; ++c)
                    t.corners[c] = glm::vec3(instance.toWorld * glm::vec4(p.positions[p.indices[i + c]], 1.0f));
                t.doubleSided = scene.materials[std::size_t(p.material)].doubleSided;
                if (glm::determinant(glm::mat3(instance.toWorld)) < 0) std::swap(t.corners[1], t.corners[2]);
                sum += 0.5 * double(glm::length(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0])));
                all.list.push_back(t);
                all.areaSum.push_back(sum);
            }
    return all;
}

/// A direction of the hemisphere around `normal`, by the cosine.
glm::vec3 cosineDirection(glm::vec3 normal, float u, float v) {
    const float z = std::sqrt(1 - u), r = std::sqrt(u), phi = 2 * std::numbers::pi_v<float> * v;
    const glm::vec3 side =
        glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    return glm::normalize(z * normal + r * (std::cos(phi) * side + std::sin(phi) * glm::cross(normal, side)));
}

/// Whether somebody could stand in front of the surface: most of what it sees are fronts (or sky), and something is
/// not so near that the point lies in a crack.
Result<bool> inTheOpen(const Tracer& tracer, glm::vec3 position, glm::vec3 normal, float scale, Uniform& uniform) {
    std::array<Ray, kOpenRays> rays;
    for (Ray& ray : rays) {
        const float u = uniform(), v = uniform();
        ray.origin = position + normal * (1e-4f * scale);
        ray.direction = cosineDirection(normal, u, v);
    }
    std::array<Hit, kOpenRays> hits;
    std::array<Surface, kOpenRays> surfaces;
    if (auto hit = tracer.closestHits(rays, hits); !hit) return hit.error();
    if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found.error();
    int backs = 0, far = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        backs += hits[i].valid() && surfaces[i].backface ? 1 : 0;
        far += hits[i].distance > 1e-2f * scale ? 1 : 0;
    }
    return backs < kInMatter * kOpenRays && far > kOpenRays / 4;
}

}  // namespace

Result<std::vector<FieldQuery>> surfaceQueries(const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                                               int count) {
    const Triangles all = worldTriangles(scene, pose);
    std::vector<FieldQuery> queries;
    if (all.list.empty() || !(all.areaSum.back() > 0)) return queries;
    const glm::vec3 size = pose.bounds.size();
    const float scale = std::cbrt(std::max(size.x * size.y * size.z, 1e-9f));
    Uniform uniform;
    for (int attempt = 0; attempt < 20 * count && int(queries.size()) < count; ++attempt) {
        const double at = double(uniform()) * all.areaSum.back();
        const auto found = std::upper_bound(all.areaSum.begin(), all.areaSum.end(), at);
        const Triangle& t = all.list[std::min(std::size_t(found - all.areaSum.begin()), all.list.size() - 1)];
        const float u = std::sqrt(uniform()), v = uniform(), side = uniform(), a = uniform(), b = uniform();
        const glm::vec3 position = (1 - u) * t.corners[0] + u * (1 - v) * t.corners[1] + u * v * t.corners[2];
        glm::vec3 normal = glm::normalize(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
        if (t.doubleSided && side < 0.5f) normal = -normal;
        if (!std::isfinite(normal.x)) continue;
        const auto open = inTheOpen(tracer, position, normal, scale, uniform);
        if (!open) return open.error();
        if (*open) queries.push_back({position, normal, cosineDirection(normal, a, b)});
    }
    return queries;
}

Result<SurfacePoints> traceSurfacePoints(const Context& context, const tool::LoadedSetup& setup, const Tracer& tracer,
                                         int count, int samples) {
    SurfacePoints points;
    auto queries = surfaceQueries(*setup.scene, setup.pose, tracer, count);
    if (!queries) return queries.error();
    points.queries = std::move(*queries);
    const auto reference = PathTracer::create(context, *setup.scene, setup.pose, tracer, setup.lighting);
    if (!reference) return reference.error();
    const auto truth = reference->irradiance(points.queries, samples);
    if (!truth) return truth.error();
    for (const ReferenceIrradiance& e : *truth) {
        points.truth.push_back(luminance(e.mean));
        points.standardError.push_back(luminance(e.standardError));
    }
    return points;
}

SurfaceError compareAtSurfaces(const std::vector<double>& field, const SurfacePoints& points) {
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
    const tool::Percentiles p = tool::percentiles(ratios);
    SurfaceError error;
    error.mean = truth > 0 ? light / truth : 0;
    error.rms = std::sqrt(std::max(0.0, squares / double(std::max<std::size_t>(1, seen)))) / mean;
    error.low = p.low;
    error.median = p.median;
    error.high = p.high;
    error.points = seen;
    return error;
}

Result<SurfaceError> compareAtSurfaces(const Field& field, const SurfacePoints& points) {
    std::vector<glm::vec3> answers(points.queries.size());
    if (const auto asked = field.irradiance(points.queries, answers); !asked) return asked.error();
    std::vector<double> light;
    for (const glm::vec3& e : answers) light.push_back(luminance(e));
    return compareAtSurfaces(light, points);
}

Result<std::vector<SurfaceRow>> measureSurface(const Context& context, const std::string& name,
                                               const tool::LoadedSetup& setup, bool updatesToo) {
    const auto tracer = makeEmbreeTracer(context, *setup.scene, setup.pose);
    if (!tracer) return tracer.error();
    const auto points = traceSurfacePoints(context, setup, **tracer, kPoints, kPathsPerPoint);
    if (!points) return points.error();
    std::vector<SurfaceRow> rows;
    for (const bool plain : {false, true}) {
        if (plain && !updatesToo) break;
        FieldDesc desc;
        desc.volumes = {setup.grid};
        auto field = Field::create(context, desc);
        if (!field) return field.error();
        if (!plain) {
            const auto done = field->converge(**tracer, setup.lighting, kTolerance, kMostUpdates);
            if (!done) return done.error();
        }
        for (int i = 0; plain && i < kPlainUpdates; ++i)
            if (const auto done = field->update(**tracer, setup.lighting); !done) return done.error();
        const auto error = compareAtSurfaces(*field, *points);
        if (!error) return error.error();
        rows.push_back({name, probeCount(setup.grid), plain ? "300 updates" : "converge", *error});
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
