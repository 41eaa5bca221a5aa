// Fog in two rooms, lit by the field: points in the air are asked as surfaces are. Probes in the air sleep unless the
// field is told of the fog (FieldControl::setMedia). The path tracer says what is right.
// Usage: fog [HEIGHT [PICTURE.png]]
#include <cstdio>
#include <cstdlib>
#include <random>

#include "fog.h"

using namespace probegi;

namespace {

struct World {
    Context context = Context::create().value();
    Scene scene = makeBuiltinScene("two-rooms").value();
    ScenePose pose = poseAt(scene);
    Lighting lighting{pose.lights, scene.sky};
    std::unique_ptr<Tracer> tracer = makeEmbreeTracer(context, scene, pose).value();
    Fog fog{.where = {{-5, 0, -2.4f}, {5, 2.7f, 2.4f}}};

    Field settledField(bool states) const {
        FieldDesc desc;
        desc.volumes = {placeVolume(*tracer, {.targetProbes = 8000}).value()};
        desc.probeStates = states;
        Field field = Field::create(context, desc).value();
        field.control().setMedia(std::span(&fog.where, 1)).value();
        for (int frame = 0; frame < 60; ++frame) field.update(*tracer, lighting).value();
        return field;
    }
};

/// Points in the air of one room, 0 the sunlit one.
std::vector<glm::vec3> pointsInRoom(int room) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<glm::vec3> points;
    for (int i = 0; i < 40; ++i)
        points.emplace_back((room == 0 ? -4.6f : 0.6f) + 4 * unit(random), 0.4f + 2 * unit(random),
                            -2 + 4 * unit(random));
    return points;
}

float meanOf(const std::vector<glm::vec3>& light) {
    float sum = 0;
    for (const glm::vec3& l : light) sum += (l.x + l.y + l.z) / (3 * float(light.size()));
    return sum;
}

float truthAt(const World& world, std::span<const glm::vec3> points) {
    const auto reference =
        PathTracer::create(world.context, world.scene, world.pose, *world.tracer, world.lighting).value();
    std::vector<FieldQuery> queries;
    for (const glm::vec3& point : points)
        for (const glm::vec3 normal : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
            for (const float sign : {1.0f, -1.0f}) queries.push_back({.position = point, .normal = sign * normal});
    const std::vector<ReferenceIrradiance> answers = reference.irradiance(queries, 300).value();
    float sum = 0;
    for (const ReferenceIrradiance& e : answers)
        sum += (e.mean.x + e.mean.y + e.mean.z) / (3 * 3.14159265f * float(queries.size()));
    return sum;
}

bool lightInTheAirIsRight(const World& world, const Field& all, const Field& asleep) {
    bool right = true;
    for (const int room : {0, 1}) {
        const std::vector<glm::vec3> points = pointsInRoom(room);
        const float full = meanOf(meanRadiance(all, points)), awake = meanOf(meanRadiance(asleep, points)),
                    truth = truthAt(world, points);
        std::printf("room %d: %.4f, with sleeping probes %.4f, path traced %.4f W/sr/m^2\n", room, full, awake, truth);
        right = right && std::abs(full / truth - 1) < 0.08f && std::abs(awake / full - 1) < 0.03f;
    }
    const std::size_t probes = all.control().tasks().size(), tasks = asleep.control().tasks().size();
    std::printf("updated: %zu of %zu probes\n", tasks, probes);
    return right && tasks < probes;
}

bool run(int height, const char* file) {
    const World world;
    const Field all = world.settledField(false), asleep = world.settledField(true);
    const bool right = lightInTheAirIsRight(world, all, asleep);
    PictureDesc desc{.camera = world.pose.cameras[0]};
    desc.height = height;
    desc.width = 16 * height / 9;
    Picture picture = renderPicture(world.context, *world.tracer, world.lighting, &asleep, desc).value().picture;
    addFog(world.fog, asleep, *world.tracer, world.lighting, desc.camera, picture);
    if (file) writeImage(file, picture.color, {.exposure = autoExposure(picture.color)}).value();
    return right;
}

}  // namespace

int main(int count, char** arguments) {
    try {
        return run(count > 1 ? std::atoi(arguments[1]) : 360, count > 2 ? arguments[2] : nullptr) ? 0 : 1;
    } catch (const BadResult& failure) {
        std::fprintf(stderr, "fog: %s\n", failure.error().message.c_str());
        return 1;
    }
}
