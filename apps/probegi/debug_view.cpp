#include "debug_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <new>
#include <numbers>
#include <vector>

#include "camera_rays.h"
#include "probe_balls.h"
#include "probegi/masks.h"
#include "probegi/measure.h"
#include "probegi/tracer.h"

namespace probegi::tool {

namespace {

constexpr float kGrey = 0.45f;

glm::vec3 volumesAt(const Field& field, const ShownPoint& point) {
    glm::vec3 colour(0.0f);
    const auto shares = field.control().volumeShares(point.position);
    for (std::size_t volume = 0; shares && volume < shares->size(); ++volume)
        colour += (*shares)[volume] * colourOf(volume);
    return colour;
}

glm::vec3 coverageAt(const Field& field, const ShownPoint& point) {
    return glm::mix(glm::vec3(0.85f, 0.1f, 0.05f), glm::vec3(0.2f, 0.75f, 0.3f),
                    field.control().coverage(point.position));
}

// Of probes that shine in colours: those of the probes that answer, by their weights.
glm::vec3 paintAt(const Field& field, const ShownPoint& point) {
    const glm::vec3 e =
        field.irradiance({.position = point.position, .normal = point.normal, .toViewer = point.toViewer});
    return glm::clamp(e * std::numbers::inv_pi_v<float>, 0.0f, 1.0f);
}

// Lets each probe, or each cluster of probes, shine in a colour of its own, in all directions. Returns what the probes
// stored.
Result<FieldSnapshot> paintProbes(Field& field, Paint paint) {
    const std::shared_ptr<const Masks> masks = field.control().settings().masks;
    if (paint == Paint::clusters && !masks)
        return fail(ErrorCode::invalidArgument, "--debug clusters shows masks; add --leak-guard masks");
    const auto stored = field.read();
    if (!stored) return stored.error();
    FieldSnapshot painted = *stored;
    const std::size_t texels = painted.irradiance.size() / (3 * std::size_t(painted.slots.count));
    for (std::size_t i = 0; i < painted.irradiance.size(); ++i) {
        const std::size_t slot = i / (3 * texels);
        const float channel =
            colourOf(paint == Paint::clusters ? std::size_t(masks->cluster(int(slot))) : slot)[int(i % 3)];
        painted.irradiance[i] = glm::packHalf1x16(std::pow(channel, 0.2f));  // (E / pi)^(1/5)
    }
    if (auto written = field.write(painted); !written) return written.error();
    return *stored;
}

glm::vec3 stateColour(const ShownProbe& shown) {
    const ProbeState& probe = shown.state;
    switch (probe.activity()) {
        case ProbeActivity::uninitialized:
            return {0.9f, 0.2f, 0.9f};
        case ProbeActivity::off:
            return {0.94f, 0.25f, 0.21f};
        case ProbeActivity::sleeping:
            return {0.31f, 0.49f, 1.0f};
        case ProbeActivity::newlyAwake:
        case ProbeActivity::newlyVigilant:
            return {0.95f, 0.77f, 0.19f};
        case ProbeActivity::awake:
            return {0.95f, 0.5f, 0.1f};
        case ProbeActivity::vigilant:
            return {0.21f, 0.77f, 0.42f};
    }
    return {};
}

glm::vec3 offsetColour(const ShownProbe& probe) {
    const glm::vec3 share = glm::abs(probe.state.offset());
    const float most = std::max({share.x, share.y, share.z}) / 0.45f;
    return glm::mix(glm::vec3(0.85f), glm::vec3(0.95f, 0.35f, 0.05f), std::sqrt(std::min(most, 1.0f)));
}

// Whether the probe is updated at all.
bool isActive(const ProbeState& probe) {
    return probe.activity() != ProbeActivity::off && probe.activity() != ProbeActivity::sleeping;
}

// From red by way of yellow to green.
glm::vec3 trafficColour(float share) {
    constexpr glm::vec3 kRed(0.9f, 0.15f, 0.1f), kYellow(0.95f, 0.8f, 0.15f), kGreen(0.15f, 0.75f, 0.3f);
    return share < 0.5f ? glm::mix(kRed, kYellow, 2 * share) : glm::mix(kYellow, kGreen, 2 * share - 1);
}

glm::vec3 ageColour(const ShownProbe& probe) {
    constexpr float kOld = 64;  // updates
    if (!isActive(probe.state)) return glm::vec3(kGrey);
    return trafficColour(1 - std::min(1.0f, std::log2(1.0f + float(probe.age)) / std::log2(1.0f + kOld)));
}

glm::vec3 confidenceColour(const ShownProbe& probe) {
    return isActive(probe.state) ? trafficColour(std::sqrt(std::min(1.0f, probe.state.confidence())))
                                 : glm::vec3(kGrey);
}

// All probes as balls; those that are off stand in walls.
Result<std::vector<Ball>> probeBalls(const DebugView& view, const Field& field) {
    const auto stored = field.read();
    if (!stored) return stored.error();
    std::vector<Ball> balls;
    int slot = 0;
    for (const VolumeDesc& volume : field.desc().volumes) {
        const float radius = kBallRadius * std::min({volume.spacing.x, volume.spacing.y, volume.spacing.z});
        for (const int end = slot + probeCount(volume); slot < end; ++slot) {
            const ProbeState& probe = stored->state(slot);
            balls.push_back({field.control().probePosition(slot), radius,
                             view.ball({probe, field.control().updateAge(slot)}),
                             probe.activity() == ProbeActivity::off});
        }
    }
    return balls;
}

// Each primitive in a colour of its own, over what is drawn already.
Result<void> drawPrimitives(const Tracer& tracer, std::span<const Ray> rays, std::span<glm::vec3> pixels) {
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    if (auto hit = tracer.closestHits(rays, hits); !hit) return hit;
    if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (hits[i].valid()) pixels[i] = colourOf(std::size_t(hits[i].primitive)) * shadeOf(surfaces[i], rays[i]);
    return {};
}

// Colours, and the distances of what is seen.
Result<void> drawRows(const DebugView& view, const Field& field, const Tracer& tracer, std::span<const Ray> rays,
                      std::span<glm::vec3> pixels, std::span<glm::vec3> depth) {
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    if (auto hit = tracer.closestHits(rays, hits); !hit) return hit;
    if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (hits[i].valid()) {
            const ShownPoint point{surfaces[i].position, surfaces[i].shadingNormal, -rays[i].direction};
            const glm::vec3 colour = view.colour ? view.colour(field, point) : glm::vec3(kGrey);
            pixels[i] = colour * shadeOf(surfaces[i], rays[i]);
            depth[i] = glm::vec3(hits[i].distance);
        }
    return {};
}

Result<HdrImage> draw(const DebugView& view, const Field& field, const Tracer& tracer, const Tracer* primitives,
                      const PlacedCamera& camera, int width, int height) {
    constexpr std::size_t kBatch = 65536;  // bounds the memory for surfaces
    HdrImage image;
    image.width = width;
    image.height = height;
    image.pixels.assign(std::size_t(width) * std::size_t(height), glm::vec3(0.0f));
    HdrImage depth = image;
    const std::vector<Ray> rays = primaryRays(camera, width, height);
    for (std::size_t begin = 0; begin < rays.size(); begin += kBatch) {
        const std::size_t count = std::min(kBatch, rays.size() - begin);
        const std::span<const Ray> batch = std::span(rays).subspan(begin, count);
        const std::span<glm::vec3> pixels = std::span(image.pixels).subspan(begin, count);
        if (auto drawn = drawRows(view, field, tracer, batch, pixels, std::span(depth.pixels).subspan(begin, count));
            !drawn)
            return drawn.error();
        if (view.primitives && primitives)
            if (auto drawn = drawPrimitives(*primitives, batch, pixels); !drawn) return drawn.error();
    }
    if (view.ball) {
        const auto balls = probeBalls(view, field);
        if (!balls) return balls.error();
        drawBalls(image, std::move(depth), camera, *balls);
    }
    return linearFromDisplay(image);
}

}  // namespace

std::span<const DebugView> debugViews() {
    static constexpr DebugView kViews[] = {
        {"volumes", "which volume answers, each in a colour of its own, blended by their shares", false, volumesAt,
         nullptr},
        {"sdf", "the primitives of --sdf, each in a colour of its own; grey: surfaces without one", false, nullptr,
         nullptr, true},
        {"coverage", "green where the volumes cover a point, red where they do not", false, coverageAt, nullptr},
        {"weights",
         "each probe in a colour of its own; a surface has those of the probes that light it, by their weights: an "
         "edge "
         "is where a probe stops being seen",
         true, paintAt, nullptr, false, Paint::probes},
        {"clusters",
         "each cluster of probes in a colour; a surface has those of the clusters that light it; with --leak-guard "
         "masks",
         true, paintAt, nullptr, false, Paint::clusters},
        {"states",
         "the probes: green those that surfaces use (vigilant), orange awake for what moves, yellow newly so, blue "
         "asleep, red off; see --probe-states",
         true, nullptr, stateColour},
        {"offsets", "the probes where they stand, the redder the farther from the grid; see --relocation", true,
         nullptr, offsetColour},
        {"age",
         "the probes, green those of the last update, yellow those of 7 updates ago, red those of 64 and more; see "
         "--budget",
         true, nullptr, ageColour},
        {"confidence",
         "the probes, green those that average over the longest window, yellow over a quarter of it, red those that "
         "see "
         "light change or are new",
         true, nullptr, confidenceColour}};
    return kViews;
}

const DebugView* findDebugView(const std::string& name) {
    const auto views = debugViews();
    const auto found = std::find_if(views.begin(), views.end(), [&](const DebugView& v) { return v.name == name; });
    return found == views.end() ? nullptr : &*found;
}

Result<HdrImage> drawDebugView(const DebugView& view, Field& field, const Tracer& tracer, const Tracer* primitives,
                               const PlacedCamera& camera, int width, int height) try {
    if (view.paint == Paint::none) return draw(view, field, tracer, primitives, camera, width, height);
    const auto stored = paintProbes(field, view.paint);
    if (!stored) return stored.error();
    auto image = draw(view, field, tracer, primitives, camera, width, height);
    if (auto written = field.write(*stored); !written) return written.error();
    return image;
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory for the debug picture; choose a smaller --size");
}

}  // namespace probegi::tool
