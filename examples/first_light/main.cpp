// From a scene to an answer: how much light arrives at a point of Cornell's box that no lamp reaches directly?
#include <probegi/probegi.h>

#include <cstdio>

using namespace probegi;

static int run() {
    // [readme]
    const Context context = Context::create().value();  // .value() throws on failure; .error().message says why
    const Scene scene = makeBuiltinScene("cornell").value();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const auto tracer = makeEmbreeTracer(context, scene, pose).value();

    FieldDesc desc;
    desc.grid = placeGrid(pose.bounds, {.targetProbes = 1000}).value();
    Field field = Field::create(context, desc).value();
    for (int frame = 0; frame < 200; ++frame) {  // an engine does one update a frame
        field.update(*tracer, lighting).value();
    }

    const glm::vec3 underCeiling{pose.bounds.centre().x, pose.bounds.upper.y - 0.1f, pose.bounds.centre().z + 0.3f};
    const glm::vec3 e = field.irradiance({.position = underCeiling, .normal = {0, -1, 0}, .toViewer = {0, -1, 0}});
    std::printf("irradiance of the ceiling: %.3f %.3f %.3f W/m^2\n", e.x, e.y, e.z);
    // [/readme]

    // The truth, by path tracing the same question.
    const PathTracer reference = PathTracer::create(context, scene, pose, *tracer, lighting).value();
    const FieldQuery query{.position = underCeiling, .normal = {0, -1, 0}};
    const glm::vec3 truth = reference.irradiance(std::span(&query, 1), 20000).value()[0].mean;
    std::printf("path traced:               %.3f %.3f %.3f W/m^2\n", truth.x, truth.y, truth.z);
    const bool close = e.x > 0.75f * truth.x && e.x < 1.25f * truth.x && e.y > 0.75f * truth.y && e.y < 1.25f * truth.y;
    return close ? 0 : 1;
}

int main() {
    try {
        return run();
    } catch (const tl::bad_expected_access<Error>& failure) {
        std::fprintf(stderr, "first_light: %s\n", failure.error().message.c_str());
        return 1;
    }
}
