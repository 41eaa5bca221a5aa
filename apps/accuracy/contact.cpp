#include "contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "camera_rays.h"
#include "probegi/reference.h"

namespace probegi::accuracy {

namespace {

constexpr int kWidth = 960, kHeight = 540;
constexpr int kStride = 11;  ///< pixels from one that is compared to the next; odd, as the noise has a period of 4
constexpr float kTolerance = 0.01f;  ///< of converge()
constexpr int kMostUpdates = 64;     ///< of converge()
constexpr int kPlainUpdates = 300;

// A nook: so much of its light would come from less than so many spacings away.
constexpr float kNookDistance = 0.5f, kNookShare = 0.3f;
constexpr int kNookRays = 128;

double luminance(glm::vec3 c) {
    return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
}

/// Some pixels of a picture, what they show and its light.
struct Truth {
    std::vector<std::size_t> pixels;
    std::vector<FieldQuery> points;
    std::vector<bool> nook;
    std::vector<ReferenceIrradiance> light;
};

Result<void> findPoints(const Tracer& tracer, const PlacedCamera& camera, Truth& truth) {
    const std::vector<Ray> all = tool::primaryRays(camera, kWidth, kHeight);
    std::vector<Ray> rays;
    std::vector<std::size_t> pixels;
    for (int y = kStride / 2; y < kHeight; y += kStride)
        for (int x = kStride / 2; x < kWidth; x += kStride) {
            pixels.push_back(std::size_t(y) * kWidth + std::size_t(x));
            rays.push_back(all[pixels.back()]);
        }
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    if (auto hit = tracer.closestHits(rays, hits); !hit) return hit;
    const float spread = 2 * std::tan(camera.yfov / 2) / float(kHeight);
    if (auto found = tracer.filteredSurfaces(rays, hits, spread, surfaces); !found) return found;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (hits[i].valid() && !surfaces[i].backface) {
            truth.pixels.push_back(pixels[i]);
            truth.points.push_back({surfaces[i].position, surfaces[i].shadingNormal, -rays[i].direction});
        }
    return {};
}

// Directions of equal weight in E: a sphere's points added to the normal.
glm::vec3 direction(glm::vec3 normal, int i) {
    const float z = 1 - (2 * float(i) + 1) / float(kNookRays), r = std::sqrt(1 - z * z);
    const float phi = 2 * std::numbers::pi_v<float> * float(i) * std::numbers::phi_v<float>;
    return glm::normalize(normal * 1.0001f + glm::vec3(r * std::cos(phi), r * std::sin(phi), z));
}

Result<void> findNooks(const Tracer& tracer, float distance, Truth& truth) {
    std::vector<Ray> rays(kNookRays);
    std::vector<std::uint8_t> blocked(kNookRays);
    for (const FieldQuery& point : truth.points) {
        for (int i = 0; i < kNookRays; ++i)
            rays[std::size_t(i)] = {point.position, 1e-3f * distance, direction(point.normal, i), distance};
        if (auto traced = tracer.occluded(rays, blocked); !traced) return traced;
        const auto count = std::count_if(blocked.begin(), blocked.end(), [](std::uint8_t b) { return b != 0; });
        truth.nook.push_back(float(count) > kNookShare * float(kNookRays));
    }
    return {};
}

ContactError compare(const HdrImage& irradiance, const Truth& truth, bool nooksOnly) {
    double sum = 0, exact = 0, all = 0, squares = 0;
    ContactError error;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const double right = luminance(truth.light[i].mean), noise = luminance(truth.light[i].standardError);
        all += right;
        if (nooksOnly && !truth.nook[i]) continue;
        const double value = luminance(irradiance.pixels[truth.pixels[i]]);
        sum += value;
        exact += right;
        squares += (value - right) * (value - right) - noise * noise;
        ++error.points;
    }
    if (error.points == 0) return error;
    error.ratio = sum / exact;
    error.rms = std::sqrt(std::max(squares, 0.0) / error.points) / (exact / error.points);
    error.light = exact / all;
    return error;
}

Result<Truth> findTruth(const Context& context, const tool::LoadedSetup& setup, const Tracer& tracer,
                        int pathsPerPoint) {
    Truth truth;
    if (auto found = findPoints(tracer, setup.camera, truth); !found) return found.error();
    const glm::vec3 spacing = setup.grid.spacing;
    if (auto found = findNooks(tracer, kNookDistance * (spacing.x + spacing.y + spacing.z) / 3, truth); !found)
        return found.error();
    const auto pathTracer = PathTracer::create(context, *setup.scene, setup.pose, tracer, setup.lighting);
    if (!pathTracer) return pathTracer.error();
    auto light = pathTracer->irradiance(truth.points, pathsPerPoint);
    if (!light) return light.error();
    truth.light = std::move(*light);
    return truth;
}

}  // namespace

Result<std::vector<ContactRow>> measureContact(const Context& context, const std::string& name,
                                               const tool::LoadedSetup& setup, int pathsPerPoint) {
    const auto tracer = makeEmbreeTracer(context, *setup.scene, setup.pose);
    if (!tracer) return tracer.error();
    const auto truth = findTruth(context, setup, **tracer, pathsPerPoint);
    if (!truth) return truth.error();
    std::vector<ContactRow> rows;
    for (const bool plain : {false, true}) {
        FieldDesc fieldDesc;
        fieldDesc.volumes = setup.volumes;
        auto field = Field::create(context, fieldDesc);
        if (!field) return field.error();
        if (!plain) {
            const auto done = field->converge(**tracer, setup.lighting, kTolerance, kMostUpdates);
            if (!done) return done.error();
        }
        for (int i = 0; plain && i < kPlainUpdates; ++i)
            if (const auto done = field->update(**tracer, setup.lighting); !done) return done.error();
        for (const bool contact : {false, true}) {
            PictureDesc desc{.camera = setup.camera, .width = kWidth, .height = kHeight, .samplesPerAxis = 1};
            desc.diffuseOnly = true;
            desc.contact = contact;
            const auto drawn = renderPicture(context, **tracer, setup.lighting, &*field, desc);
            if (!drawn) return drawn.error();
            rows.push_back({name, plain ? fmt::format("{} updates", kPlainUpdates) : "converge", contact,
                            compare(drawn->picture.irradiance, *truth, false),
                            compare(drawn->picture.irradiance, *truth, true)});
        }
    }
    return rows;
}

std::string contactTable(const std::vector<ContactRow>& rows) {
    if (rows.empty()) return {};
    std::string text = fmt::format(
        "\n### Contact light, irradiance of a picture's pixels over the path tracer's\n\n"
        "Nooks: pixels of which {:.0f} % of the directions, cosine-weighted, meet something within {} of the probes' "
        "spacing.\n\n"
        "| scene | field by | contact | mean | RMS | nooks: mean | RMS | share of light | pixels, in nooks |\n"
        "|---|---|---|---:|---:|---:|---:|---:|---:|\n",
        100 * kNookShare, kNookDistance);
    for (const ContactRow& row : rows)
        text +=
            row.missing.empty()
                ? fmt::format("| {} | {} | {} | {:+.1f} % | {:.1f} % | {:+.1f} % | {:.1f} % | {:.0f} % | {}, {} |\n",
                              row.scene, row.run, row.contact ? "on" : "off", 100 * (row.all.ratio - 1),
                              100 * row.all.rms, 100 * (row.nooks.ratio - 1), 100 * row.nooks.rms,
                              100 * row.nooks.light, row.all.points, row.nooks.points)
                : fmt::format("| {} | {} | | | | | | | |\n", row.scene, row.missing);
    return text;
}

}  // namespace probegi::accuracy
