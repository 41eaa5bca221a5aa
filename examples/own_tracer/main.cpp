// A field updated with an engine's own rays: the engine keeps its ray tracer and passes the results in, and ProbeGI
// runs on the engine's jobs. Needs only GLM and Highway. Writes own_tracer.png if ProbeGI was built with file formats,
// and checks points whose light is known.
#include <probegi/probegi.h>

#include <cstdio>
#include <glm/common.hpp>

#include "jobs.h"
#include "sphere_world.h"

using namespace probegi;

namespace {

constexpr float kPi = 3.14159265f;

/// Radiance reflected by a surface, from the sun and the field so far (so each update adds a bounce).
glm::vec3 shade(const SphereWorld& world, const Field& field, const SphereWorld::Surface& surface, glm::vec3 toViewer) {
    const glm::vec3 indirect = field.irradiance({surface.position, surface.normal, toViewer});
    return surface.albedo / kPi * (world.sunlight(surface) + indirect);
}

RayDatum traceProbeRay(const SphereWorld& world, const Field& field, glm::vec3 origin, glm::vec3 direction) {
    const auto surface = world.trace(origin, direction);
    if (surface.missed()) return {world.skyRadiance, SphereWorld::kMiss};
    const bool inside = glm::dot(surface.normal, direction) > 0;  // the probe is in a sphere or below the plane
    if (inside) return {glm::vec3(0), -surface.distance};
    return {shade(world, field, surface, -direction), surface.distance};
}

/// One update: the directions come from the field, the data goes back in the same order.
Result<UpdateTimes> updateOnce(const SphereWorld& world, Field& field, std::vector<RayDatum>& rays) {
    rays.clear();
    for (const ProbeTask& task : field.control().tasks()) {
        for (const glm::vec3& direction : field.control().rayDirections()) {
            rays.push_back(traceProbeRay(world, field, task.origin, direction));
        }
    }
    return field.update(rays);
}

[[maybe_unused]] HdrImage drawPicture(const SphereWorld& world, const Field& field, int width, int height) {
    HdrImage image(width, height);
    const glm::vec3 eye{0, 2.2f, 6.5f};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float u = (float(x) + 0.5f) / float(width) * 2 - 1;
            const float v = 1 - (float(y) + 0.5f) / float(height) * 2;
            const float aspect = float(width) / float(height);
            const glm::vec3 direction = glm::normalize(glm::vec3(0.5f * aspect * u, 0.5f * v - 0.22f, -1));
            const auto surface = world.trace(eye, direction);
            image.at(x, y) = surface.missed() ? world.skyRadiance : shade(world, field, surface, -direction);
        }
    }
    return image;
}

/// Checks results that can be derived by hand.
bool lightIsRight(const SphereWorld& world, const Field& field) {
    const auto e = [&](glm::vec3 position, glm::vec3 normal) { return field.irradiance({position, normal}); };
    const glm::vec3 open = e({0, 0, -3.5f}, {0, 1, 0});  // sees nearly all of the sky
    const glm::vec3 sky = kPi * world.skyRadiance;
    const glm::vec3 beside = e({-1.3f, 0.5f, 1.3f}, {0, 0, -1});  // faces the red sphere
    std::printf("open ground: %.3f W/m^2 of green light; the whole sky gives %.3f\n", open.y, sky.y);
    std::printf("beside the red sphere: red / blue is %.2f; of the sky alone it is %.2f\n", beside.x / beside.z,
                sky.x / sky.z);
    return open.y > 0.9f * sky.y && open.y < 1.05f * sky.y && beside.x / beside.z > 1.3f * sky.x / sky.z;
}

}  // namespace

int main() {
    const SphereWorld world;
    FieldDesc desc;
    desc.volumes = {{.origin = {-5.25f, 0.15f, -5.25f}, .spacing = glm::vec3(0.75f), .counts = {15, 5, 15}}};
    const FieldSettings settings{.hysteresis = 0.9f, .visibilityHysteresis = 0.9f};
    const auto context = Context::create({.parallelFor = runJobs});
    auto field = context.and_then([&](const Context& c) { return Field::create(c, desc, settings); });
    if (!field) {
        std::fprintf(stderr, "own_tracer: %s\n", field.error().message.c_str());
        return 1;
    }
    std::vector<RayDatum> rays;
    for (int frame = 0; frame < 60; ++frame) {
        if (const auto done = updateOnce(world, *field, rays); !done) {
            std::fprintf(stderr, "own_tracer: %s\n", done.error().message.c_str());
            return 1;
        }
    }
#ifdef PROBEGI_HAS_IO
    if (const auto saved = writeImage("own_tracer.png", drawPicture(world, *field, 480, 270), {.filmic = true});
        !saved) {
        std::fprintf(stderr, "own_tracer: %s\n", saved.error().message.c_str());
        return 1;
    }
#endif
    return lightIsRight(world, *field) ? 0 : 1;
}
