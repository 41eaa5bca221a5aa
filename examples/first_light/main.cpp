// From a scene to an answer: how much light arrives at the ceiling of the Cornell box, which its lamp cannot reach?
#include <probegi/probegi.h>

#include <cstdio>

using namespace probegi;

static int run() {
    // [readme]
    const Context context = Context::create().value();  // .value() throws on failure; .error().message says why
    const auto backend = openBackend(context, {.kind = BackendKind::cpu}).value();  // or BackendKind::vulkan
    const Scene scene = makeBuiltinScene("cornell").value();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const auto tracer = backend->openScene(scene, pose).value();

    FieldDesc desc;
    desc.volumes = {placeVolume(pose.bounds, {.targetProbes = 1000}).value()};
    Field field = backend->makeField(desc).value();
    for (int frame = 0; frame < 200; ++frame) {  // an engine does one update per frame
        field.update(*tracer, lighting).value();
    }

    const FieldQuery ceiling{.position = {4.0f, 5.45f, -4.0f}, .normal = {0, -1, 0}};
    const glm::vec3 e = field.irradiance(ceiling);
    std::printf("the ceiling receives %.2f %.2f %.2f W/m^2\n", e.x, e.y, e.z);
    // [/readme]

    // The ground truth: the same query, path-traced.
    const PathTracer reference = PathTracer::create(context, scene, pose, *tracer, lighting).value();
    const glm::vec3 truth = reference.irradiance(std::span(&ceiling, 1), 20000).value()[0].mean;
    std::printf("path traced:         %.2f %.2f %.2f W/m^2\n", truth.x, truth.y, truth.z);
    const auto close = [&](int channel) {
        return e[channel] > 0.75f * truth[channel] && e[channel] < 1.33f * truth[channel];
    };
    return close(0) && close(1) && close(2) ? 0 : 1;
}

int main() {
    try {
        return run();
    } catch (const BadResult& failure) {
        std::fprintf(stderr, "first_light: %s\n", failure.error().message.c_str());
        return 1;
    }
}
