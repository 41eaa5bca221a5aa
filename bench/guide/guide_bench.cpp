// What a guide gains: variance x time of the path tracer with and without one, in interleaved runs of one thread.
//   probegi_guide_bench [--samples N] [--size WxH] [--rounds N] [--camera N] SCENE ...
// SCENE is builtin:NAME or a file. Times are those of the processor, so that a busy machine disturbs little. The gain
// leaves the learning out, whose time stands beside it.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "probegi/builtin_scenes.h"
#include "probegi/field.h"
#include "probegi/io.h"
#include "probegi/reference.h"

namespace {

using namespace probegi;

struct Settings {
    int samples = 32, rounds = 3, width = 240, height = 135;
    int camera = 0;
    std::vector<std::string> scenes;
};

double processorSeconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

double luminance(glm::vec3 c) {
    return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
}

/// Of one sample a pixel: variance of the luminance over the picture's mean squared, and seconds.
struct Cost {
    double variance = 0;
    double relative = 0;  ///< mean over pixels of variance over the pixel's own square
    double seconds = 0;
    double buildSeconds = 0;
    double mean = 0;
};

Result<Scene> readScene(const std::string& name) {
    constexpr std::string_view kBuiltin = "builtin:";
    if (name.rfind(kBuiltin, 0) == 0) return makeBuiltinScene(name.substr(kBuiltin.size()));
    auto loaded = loadScene(name);
    if (!loaded) return loaded.error();
    return std::move(loaded->scene);
}

Cost measure(const PathTracer& tracer, ReferenceDesc desc, const Field* guide) {
    desc.guide = guide;
    Cost cost;
    const auto timed = [&](const ReferenceDesc& what) {
        const double start = processorSeconds();
        auto picture = tracer.render(what).value();
        return std::pair(std::move(picture), processorSeconds() - start);
    };
    // A picture of few pixels is little more than the making of the guide.
    ReferenceDesc small = desc;
    small.picture.width = 16;
    small.picture.height = 9;
    small.samplesPerPixel = 1;
    if (guide) cost.buildSeconds = timed(small).second;
    const auto [first, seconds] = timed(desc);
    cost.seconds = (seconds - cost.buildSeconds) / desc.samplesPerPixel;
    const double pixels = double(first.picture.color.pixels.size());
    for (const glm::vec3& c : first.picture.color.pixels) cost.mean += luminance(c) / pixels;
    for (std::size_t i = 0; i < first.picture.color.pixels.size(); ++i) {
        const double error = luminance(first.standardError.pixels[i]);
        const double own = luminance(first.picture.color.pixels[i]);
        cost.variance += error * error * desc.samplesPerPixel / (pixels * cost.mean * cost.mean);
        cost.relative += error * error * desc.samplesPerPixel / (pixels * (own * own + 1e-4 * cost.mean * cost.mean));
    }
    return cost;
}

Result<void> bench(const std::string& name, const Settings& settings) {
    auto scene = readScene(name);
    if (!scene) return scene.error();
    const auto context = Context::create({.threads = 1, .log = {}, .progress = {}});
    if (!context) return context.error();
    const ScenePose pose = poseAt(*scene);
    const auto tracer = makeEmbreeTracer(*context, *scene, pose);
    if (!tracer) return tracer.error();
    const Lighting lighting{pose.lights, scene->sky};
    FieldDesc fieldDesc;
    const auto placed = scene->grid ? Result<GridDesc>(*scene->grid) : placeGrid(pose.bounds);
    if (!placed) return placed.error();
    fieldDesc.grid = *placed;
    auto field = Field::create(*context, fieldDesc);
    if (!field) return field.error();
    for (int i = 0; i < 24; ++i)
        if (const auto done = field->update(**tracer, lighting); !done) return done.error();
    const auto reference = PathTracer::create(*context, *scene, pose, **tracer, lighting);
    if (!reference) return reference.error();

    ReferenceDesc desc;
    const std::size_t camera = std::size_t(settings.camera);
    desc.picture.camera = camera < pose.cameras.size() ? pose.cameras[camera] : overviewCamera(pose.bounds);
    desc.picture.width = settings.width;
    desc.picture.height = settings.height;
    desc.samplesPerPixel = settings.samples;
    std::vector<double> gains, relativeGains, times;
    for (int round = 0; round < settings.rounds; ++round) {
        desc.seed = std::uint64_t(round) + 1;
        const Cost plain = measure(*reference, desc, nullptr);
        const Cost guided = measure(*reference, desc, &*field);
        gains.push_back(plain.variance * plain.seconds / (guided.variance * guided.seconds));
        relativeGains.push_back(plain.relative * plain.seconds / (guided.relative * guided.seconds));
        times.push_back(guided.seconds / plain.seconds);
        fmt::print(
            "{:16} {:4.0f} -> {:4.0f} ms a sample, variance {:8.3f} -> {:8.3f}, relative {:8.3f} -> {:8.3f}, "
            "mean {:.5f} {:.5f}, build {:.2f} s | gain {:.2f} relative {:.2f}\n",
            name.substr(name.find_last_of("/:") + 1), plain.seconds * 1e3, guided.seconds * 1e3, plain.variance,
            guided.variance, plain.relative, guided.relative, plain.mean, guided.mean, guided.buildSeconds,
            gains.back(), relativeGains.back());
        std::fflush(stdout);
    }
    return {};
}

}  // namespace

int main(int count, char** values) {
    Settings settings;
    for (int i = 1; i < count; ++i) {
        const std::string option = values[i];
        const bool last = i + 1 == count;
        if (option == "--samples" && !last)
            settings.samples = std::max(2, std::atoi(values[++i]));
        else if (option == "--rounds" && !last)
            settings.rounds = std::max(1, std::atoi(values[++i]));
        else if (option == "--camera" && !last)
            settings.camera = std::max(0, std::atoi(values[++i]));
        else if (option == "--size" && !last)
            std::sscanf(values[++i], "%dx%d", &settings.width, &settings.height);
        else
            settings.scenes.push_back(option);
    }
    for (const std::string& scene : settings.scenes)
        if (const auto done = bench(scene, settings); !done) {
            fmt::print(stderr, "{}: {}\n", scene, done.error().message);
            return 1;
        }
    return 0;
}
