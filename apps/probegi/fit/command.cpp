#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "console/output.h"
#include "console/parse.h"
#include "fit/picture.h"
#include "probegi/sdf_fit.h"
#include "scene_setup.h"
#include "sdf_scene.h"

namespace probegi::tool {

namespace {

struct FitOptions {
    SceneOptions scene;
    std::string output, keep, check, picture, stats, size = "960x540";
    int camera = 0;
    SdfFitDesc desc;
};

const char* const kFooter =
    R"(Finds boxes that stand for the scene's triangles, for probe rays that need no ray-tracing hardware: give the file to
'probegi render --sdf FILE'. It is made to be edited by hand. Primitives with "pinned": true in it are kept the next
time that the same file is written (or in the file of --keep), and the others are fitted around them.

Printed is how well they fit, by rays that start where cameras and probes can be: mean distances between the surfaces
both ways, rays that leak out through the primitives, and rays into the open that they block. From rooms and other dim
places few rays see the sky: how many of these are lost and gained tells whether windows are open and walls whole.

Example: probegi fit builtin:house -o house.sdf.json --picture house.png
Example: probegi fit sponza.glb -o sponza.sdf.json --max-primitives 128
Example: probegi fit sponza.glb --check sponza.sdf.json            (measures only))";

nlohmann::ordered_json statsOf(const FitOptions& options, const SdfScene& sdf, const SdfAccuracy& a, double seconds) {
    return {{"scene", options.scene.scene},
            {"primitives", sdf.primitives.size()},
            {"geometryBytes", sdfBytes(sdf)},
            {"seconds", seconds},
            {"rays", a.rays},
            {"skyRays", a.skyRays},
            {"toPrimitives", a.toPrimitives},
            {"toScene", a.toScene},
            {"leaking", a.leaking},
            {"blockedSky", a.blockedSky},
            {"startInside", a.startInside},
            {"dimRays", a.dimRays},
            {"dimSkyRays", a.dimSkyRays},
            {"dimBlockedSky", a.dimBlockedSky},
            {"dimLeaking", a.dimLeaking}};
}

void print(const SdfScene& sdf, const SdfAccuracy& a, std::optional<double> seconds) {
    fmt::print("{} primitives, {} bytes of geometry", sdf.primitives.size(), sdfBytes(sdf));
    if (seconds) fmt::print(", found in {:.1f} s", *seconds);
    fmt::print("\n");
    if (a.rays == 0) {
        fmt::print("nowhere in the scene is air to measure from\n");
        return;
    }
    fmt::print("mean distance   {:.3g} m from the scene's surface to the primitives', {:.3g} m back\n", a.toPrimitives,
               a.toScene);
    fmt::print("leaking         {:.2g} % of all rays meet the scene and no primitive\n", 100 * a.leaking);
    if (a.skyRays > 0)
        fmt::print("blocked sky     {:.2g} % of the rays into the open meet a primitive\n", 100 * a.blockedSky);
    else
        fmt::print("blocked sky     none is seen\n");
    fmt::print("start inside    {:.2g} % of all rays\n", 100 * a.startInside);
    if (a.dimSkyRays > 0)
        fmt::print("dim places      {:.2g} % of what they see of the sky is blocked, leaks add {:.2g} %\n",
                   100 * a.dimBlockedSky, 100 * a.dimLeaking);
}

/// The primitives whose pinned ones are kept: --keep, else the file that is about to be replaced.
Result<std::optional<SdfScene>> kept(const FitOptions& options, const Scene& scene) {
    const std::filesystem::path from = options.keep.empty() ? options.output : options.keep;
    std::error_code none;
    if (options.keep.empty() && !std::filesystem::is_regular_file(from, none)) return std::optional<SdfScene>();
    auto sdf = loadSdfOf(scene, from, options.scene.limits);
    if (!sdf) return sdf.error();
    return std::optional<SdfScene>(std::move(*sdf));
}

Result<PlacedCamera> cameraOf(const ScenePose& pose, int number) {
    if (pose.cameras.empty() && number == 0) return overviewCamera(pose.bounds);
    if (std::size_t(number) < pose.cameras.size()) return pose.cameras[std::size_t(number)];
    return fail(ErrorCode::invalidArgument,
                fmt::format("--camera {}: the scene has {} cameras, the first is 0", number, pose.cameras.size()));
}

Result<void> claimAll(const FitOptions& options, Outputs& outputs) {
    const auto claim = [&](const char* name, const std::string& path,
                           const std::vector<std::string_view>& extensions = {}) -> Result<void> {
        return path.empty() ? Result<void>() : outputs.claim(name, path, extensions);
    };
    if (auto claimed = claim("-o", options.output); !claimed) return claimed;
    if (auto claimed = claim("--picture", options.picture, pictureExtensions()); !claimed) return claimed;
    return claim("--stats", options.stats);
}

Result<void> writePicture(const Context& context, const FitOptions& options, const Scene& scene, const ScenePose& pose,
                          const PlacedCamera& camera, const Tracer& tracer, const SdfScene& sdf) {
    const PictureSize size = *parseSize(options.size);
    const auto primitives = makeSdfTracer(context, sdf, scene, pose);
    if (!primitives) return primitives.error();
    const auto image = drawPrimitives(tracer, **primitives, camera, size.width, size.height);
    if (!image) return image.error();
    return writeImage(options.picture, *image);
}

/// Fits, or reads what --check names.
Result<SdfFit> primitivesOf(const Context& context, const FitOptions& options, const Scene& scene,
                            const ScenePose& pose, const Tracer& tracer) {
    if (options.check.empty()) {
        const auto keep = kept(options, scene);
        if (!keep) return keep.error();
        SdfFitDesc desc = options.desc;
        desc.keep = *keep ? &**keep : nullptr;
        return fitSdf(context, scene, pose, tracer, desc);
    }
    auto sdf = loadSdfOf(scene, options.check, options.scene.limits);
    if (!sdf) return sdf.error();
    const auto accuracy = measureSdf(context, scene, pose, tracer, *sdf);
    if (!accuracy) return accuracy.error();
    return SdfFit{std::move(*sdf), *accuracy};
}

Result<void> fit(const FitOptions& options) {
    if (options.output.empty() == options.check.empty())
        return fail(ErrorCode::invalidArgument, "give either -o FILE, to fit, or --check FILE, to measure");
    Outputs outputs;
    if (auto claimed = claimAll(options, outputs); !claimed) return claimed;
    const auto context = makeContext(options.scene.threads);
    if (!context) return context.error();
    const auto loaded = readScene(options.scene);
    if (!loaded) return loaded.error();
    for (const std::string& warning : loaded->warnings) printWarning(warning);
    std::vector<std::filesystem::path> inputs = loaded->files;
    for (const std::string* input : {&options.keep, &options.check})
        if (!input->empty() && *input != options.output) inputs.push_back(*input);
    if (auto apart = outputs.keepApartFrom(inputs); !apart) return apart;
    const ScenePose pose = poseAt(loaded->scene, options.scene.timeOfScene);
    const auto camera = cameraOf(pose, options.camera);
    if (!camera) return camera.error();
    const auto tracer = makeEmbreeTracer(*context, loaded->scene, pose);
    if (!tracer) return tracer.error();

    const auto start = std::chrono::steady_clock::now();
    const auto found = primitivesOf(*context, options, loaded->scene, pose, **tracer);
    if (!found) return found.error();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!options.output.empty())
        if (auto written = saveSdfOf(loaded->scene, options.output, found->sdf); !written) return written;
    if (!options.picture.empty())
        if (auto drawn = writePicture(*context, options, loaded->scene, pose, *camera, **tracer, found->sdf); !drawn)
            return drawn;
    if (!options.stats.empty())
        if (auto written = writeText(options.stats, jsonText(statsOf(options, found->sdf, found->accuracy, seconds)));
            !written)
            return written;
    std::error_code none;
    const bool toPipe = std::filesystem::equivalent(options.output, "/dev/stdout", none) ||
                        std::filesystem::equivalent(options.stats, "/dev/stdout", none);
    if (!toPipe)
        print(found->sdf, found->accuracy, options.check.empty() ? std::optional<double>(seconds) : std::nullopt);
    return {};
}

void addFitOptions(CLI::App& command, FitOptions& options) {
    command.add_option("-o,--output", options.output, "the primitives, as JSON; its pinned ones are kept")
        ->type_name("FILE");
    command.add_option("--check", options.check, "measure these primitives instead")->type_name("FILE");
    command.add_option("--keep", options.keep, "keep the pinned primitives of this file")->type_name("FILE");
    command.add_option("--max-primitives", options.desc.maxPrimitives, "at most so many, 1 to 1024")
        ->type_name("N")
        ->check(inRange(1, 1024))
        ->capture_default_str();
    command.add_option("--rays", options.desc.rays, "rays by which they are placed, 1000 to 16000000")
        ->type_name("N")
        ->check(inRange(1000, 16'000'000))
        ->capture_default_str();
    command
        .add_option("--rounds", options.desc.rounds, "rounds of search, 0 to 10000: more take longer, and fit better")
        ->type_name("N")
        ->check(inRange(0, 10'000))
        ->capture_default_str();
    command.add_option("--seed", options.desc.seed, "random seed")
        ->type_name("N")
        ->check(wholeNumber())
        ->capture_default_str();
    command
        .add_option(
            "--picture", options.picture,
            "the primitives in colours over the scene in grey; white: no primitive stands for it (.png or .exr)")
        ->type_name("FILE");
    command.add_option("--camera", options.camera, "of the picture: number of the scene's camera")
        ->type_name("N")
        ->check(inRange(0, 1e6))
        ->capture_default_str();
    command.add_option("--size", options.size, "of the picture, each side 1 to 16384 pixels")
        ->type_name("WxH")
        ->check(parsedBy(parseSize))
        ->capture_default_str();
    command.add_option("--stats", options.stats, "write what is printed as JSON")->type_name("FILE");
}

}  // namespace

void addFitCommand(CLI::App& app, int& exitCode) {
    CLI::App* command =
        app.add_subcommand("fit", "find simple solids that stand for a scene, for probe rays (SDFDDGI)");
    const auto options = std::make_shared<FitOptions>();
    addSceneArgument(*command, options->scene);
    addFitOptions(*command, *options);
    addThreadsOption(*command, options->scene);
    command->footer(kFooter);
    command->callback([options, &exitCode] {
        if (const auto done = fit(*options); !done) exitCode = printError(done.error());
    });
}

}  // namespace probegi::tool
