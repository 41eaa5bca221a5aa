// The gain from guiding paths: variance x time of the path tracer with and without a guide, in interleaved runs on one
// thread.
//   probegi_guide_bench [--samples N] [--size WxH] [--rounds N] [--camera N] [--bounces N] [--edges N] SCENE ...
// SCENE is builtin:NAME or a file. Times are CPU times, so that a busy machine disturbs little. The gain does not
// include learning the guide, whose time is printed beside it. --edges N measures the variance within pixels, by N
// pairs of paths per pixel, and prints the gain without it as well. --bounces N limits the paths, to see where the
// variance and the time are.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "geometry/lighting.h"
#include "measure/luminance.h"
#include "probegi/builtin_scenes.h"
#include "probegi/field.h"
#include "probegi/io.h"
#include "probegi/reference.h"
#include "reference/path_batch.h"
#include "reference/pinhole_camera.h"

namespace {

using namespace probegi;

constexpr std::uint64_t kEdgeSeed = 0x6564676573ull, kScaleSeed = 0x7363616c65ull;

struct Settings {
    int samples = 32, rounds = 3, width = 240, height = 135;
    int camera = 0, bounces = 0, edges = 0;
    std::vector<std::string> scenes;
};

double processorSeconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

/// Variance of the luminance, and time, of one sample per pixel.
struct Cost {
    double variance = 0;  ///< mean over pixels, over the picture's mean squared
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

/// Weights the variances of pixels. The light of each comes from a separate picture: samples that missed the light
/// underestimate both a pixel's square and its variance.
class Scale {
public:
    explicit Scale(const HdrImage& picture) {
        for (const glm::vec3& c : picture.pixels) m_levels.push_back(luminance(c));
        for (const double level : m_levels) m_mean += level / double(m_levels.size());
    }
    void add(Cost& cost, std::size_t pixel, double variance) const {
        const double share = variance / double(m_levels.size()), own = m_levels[pixel];
        cost.variance += share / (m_mean * m_mean);
        cost.relative += share / (own * own + 1e-4 * m_mean * m_mean);
    }

private:
    std::vector<double> m_levels;
    double m_mean = 0;
};

Cost measure(const PathTracer& tracer, ReferenceDesc desc, const Field* guide, const Scale& scale) {
    desc.guide = guide;
    Cost cost;
    const auto timed = [&](const ReferenceDesc& what) {
        const double start = processorSeconds();
        auto picture = tracer.render(what).value();
        return std::pair(std::move(picture), processorSeconds() - start);
    };
    // With few pixels, nearly all of the time is for making the guide.
    ReferenceDesc small = desc;
    small.picture.width = 16;
    small.picture.height = 9;
    small.samplesPerPixel = 1;
    if (guide) cost.buildSeconds = timed(small).second;
    const auto [first, seconds] = timed(desc);
    cost.seconds = (seconds - cost.buildSeconds) / desc.samplesPerPixel;
    const double pixels = double(first.picture.color.pixels.size());
    for (std::size_t i = 0; i < first.picture.color.pixels.size(); ++i) {
        const double error = luminance(first.standardError.pixels[i]);
        cost.mean += luminance(first.picture.color.pixels[i]) / pixels;
        scale.add(cost, i, error * error * desc.samplesPerPixel);
    }
    return cost;
}

/// Variance within the pixels: what remains however well paths continue from the hits of their camera rays. It is the
/// only thing that two paths from the same hit have in common.
Cost edgeVariance(const Transport& transport, const PictureDesc& picture, int count, const Scale& scale) {
    const PinholeCamera camera(picture);
    Cost cost;
    for (std::size_t pixel = 0; pixel < std::size_t(picture.width) * std::size_t(picture.height); ++pixel) {
        std::vector<Ray> rays;
        std::vector<Random> random;
        for (int i = 0; i < count; ++i) {
            Random stream(kEdgeSeed, std::uint64_t(i) << 32 | pixel);
            rays.insert(rays.end(), 2, camera.ray(pixel, stream.nextPair()));
            random.push_back(stream);
            random.emplace_back(stream.bits(), pixel);
        }
        std::vector<PathResult> results(rays.size());
        (void)PathBatch(transport, {}).fromCamera(rays, random, results).value();
        double first = 0, second = 0, both = 0;
        for (std::size_t i = 0; i < results.size(); i += 2) {
            const double a = luminance(results[i].color()), b = luminance(results[i + 1].color());
            first += a;
            second += b;
            both += a * b;
        }
        scale.add(cost, pixel, (both - first * second / count) / (count - 1));
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
    const auto placed = scene->grid ? Result<VolumeDesc>(*scene->grid) : placeVolume(pose.bounds);
    if (!placed) return placed.error();
    fieldDesc.volumes = {*placed};
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
    desc.maxBounces = settings.bounces;
    const auto rendered = [&] {
        ReferenceDesc fine = desc;
        fine.samplesPerPixel *= 4;
        fine.seed = kScaleSeed;
        fine.guide = &*field;
        return reference->render(fine);
    }();
    if (!rendered) return rendered.error();
    const Scale scale(rendered->picture.color);
    const std::string shortName = name.substr(name.find_last_of("/:") + 1);
    Cost edges;
    if (settings.edges > 0) {
        const Transport transport{tracer->get(), lighting.lights, EmitterSampler(*scene, pose), SkyLight(lighting.sky),
                                  sceneMagnitude((*tracer)->bounds())};
        edges = edgeVariance(transport, desc.picture, settings.edges, scale);
        fmt::print("{:16} within pixels: variance {:.3f}, relative {:.3f}\n", shortName, edges.variance,
                   edges.relative);
    }
    for (int round = 0; round < settings.rounds; ++round) {
        desc.seed = std::uint64_t(round) + 1;
        const Cost plain = measure(*reference, desc, nullptr, scale);
        const Cost guided = measure(*reference, desc, &*field, scale);
        const double time = plain.seconds / guided.seconds;
        fmt::print(
            "{:16} {:5.1f} -> {:5.1f} ms a sample, variance {:8.3f} -> {:8.3f}, relative {:8.3f} -> {:8.3f}, "
            "mean {:.5f} {:.5f}, build {:.2f} s | gain {:.2f} relative {:.2f}",
            shortName, plain.seconds * 1e3, guided.seconds * 1e3, plain.variance, guided.variance, plain.relative,
            guided.relative, plain.mean, guided.mean, guided.buildSeconds, plain.variance / guided.variance * time,
            plain.relative / guided.relative * time);
        if (settings.edges > 0)
            fmt::print(", without edges {:.2f} relative {:.2f}",
                       (plain.variance - edges.variance) / (guided.variance - edges.variance) * time,
                       (plain.relative - edges.relative) / (guided.relative - edges.relative) * time);
        fmt::print("\n");
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
        else if (option == "--bounces" && !last)
            settings.bounces = std::max(0, std::atoi(values[++i]));
        else if (option == "--edges" && !last)
            settings.edges = std::max(2, std::atoi(values[++i]));
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
