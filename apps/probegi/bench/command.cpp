#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "backend.h"
#include "bench/gpu.h"
#include "bench/rounds.h"
#include "bench/table.h"
#include "commands.h"
#include "console/output.h"
#include "console/parse.h"
#include "scene_setup.h"
#include "sdf_scene.h"

namespace probegi::tool {

namespace {

struct BenchOptions {
    SceneOptions scene;
    BackendOptions backend;
    std::string json;
    std::string size = "1920x1080";
    int rays = FieldDesc{}.raysPerProbe;
    int rounds = 5;
    bool noGrowth = false;
    bool growthMillion = false;
};

const char* const kFooter =
    R"(Measured in turn, round by round, so that a busy machine slows all of it alike; each ratio is taken within a round.
The floor is Embree alone with the rays of one update. With --backend vulkan each pass is timed by the device itself,
and the goals are those for a data-centre GPU. A missed goal is printed, it is not a failure.

Example: probegi bench
Example: probegi bench --backend vulkan --tracer bvh
Example: probegi bench builtin:house --sdf house.sdf.json
Example: probegi bench sponza.glb --sky 0.3,0.4,0.6 --probes 22x14x32 --threads 2 --json bench.json)";

BenchPlan makePlan(const BenchOptions& options) {
    const PictureSize size = *parseSize(options.size);
    BenchPlan plan;
    plan.threads = options.scene.threads;
    plan.raysPerProbe = options.rays;
    plan.rounds = options.rounds;
    plan.width = size.width;
    plan.height = size.height;
    if (!options.noGrowth)
        plan.growth = {{{10, 10, 10}, 32}, {{20, 25, 20}, 32}, {{20, 25, 20}, 128}, {{50, 40, 50}, 32}};
    if (options.growthMillion) plan.growth.push_back({{100, 100, 100}, 32});
    return plan;
}

void showProgress(std::string_view what, int round, int rounds) {
    if (!isatty(STDERR_FILENO)) return;
    fmt::print(stderr, "\r\033[K{}: round {} of {}", what, round, rounds);
    std::fflush(stderr);
}

/// A report as text for the terminal, and as --json writes it.
struct Reported {
    std::string markdown, json;
};

Result<Reported> measure(const BenchOptions& options, const LoadedSetup& setup) {
    const std::string name = setup.scene->name.empty() ? options.scene.scene : setup.scene->name;
    if (options.backend.kind == BackendKind::vulkan)
        return runGpuBench(setup, options.backend, makePlan(options), showProgress)
            .transform([&](const GpuBenchResult& result) {
                return Reported{gpuBenchMarkdown(result, name), gpuBenchJson(result, name)};
            });
    return runBench(setup, makePlan(options), showProgress).transform([&](const BenchResult& result) {
        return Reported{benchMarkdown(result, name), benchJson(result, name)};
    });
}

Result<void> bench(const BenchOptions& options) {
    Outputs outputs;
    if (!options.json.empty())
        if (auto claimed = outputs.claim("--json", options.json); !claimed) return claimed;
    const auto setup = loadSetup(options.scene);
    if (!setup) return setup.error();
    if (auto apart = outputs.keepApartFrom(setup->files); !apart) return apart;
    const auto reported = measure(options, *setup);
    if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K");
    if (!reported) return reported.error();
    fmt::print("{}", reported->markdown);
    return options.json.empty() ? Result<void>() : writeText(options.json, reported->json);
}

void checkOptions(const CLI::App& command, const BenchOptions& options) {
    checkBackendOptions(command, options.backend);
    if (options.backend.kind == BackendKind::vulkan && options.growthMillion)
        throw CLI::ValidationError("--growth-million", "the growth table can be measured on --backend cpu only");
    if (options.backend.kind == BackendKind::vulkan && !options.scene.sdf.empty())
        throw CLI::ValidationError("--sdf", "primitives can be measured on --backend cpu only");
}

void addOptions(CLI::App& command, BenchOptions& options) {
    options.scene.scene = "builtin:atrium";
    addSceneOptions(command, options.scene);
    addBackendOptions(command, options.backend);
    addSdfOption(command, options.scene);
    command.get_option("SCENE")->required(false)->capture_default_str();
    command.add_option("--rays", options.rays, "rays per probe and update, 8 to 4096")
        ->type_name("N")
        ->check(inRange(8, 4096))
        ->capture_default_str();
    command.add_option("--rounds", options.rounds, "measured rounds, 1 to 1000")
        ->type_name("N")
        ->check(inRange(1, 1000))
        ->capture_default_str();
    command.add_option("--size", options.size, "pixels of the picture, each side 1 to 16384")
        ->type_name("WxH")
        ->check(parsedBy(parseSize))
        ->capture_default_str();
    command.add_option("--json", options.json, "also write the figures as JSON")->type_name("FILE");
    auto* without = command.add_flag("--no-growth", options.noGrowth, "leave out the growth table");
    command.add_flag("--growth-million", options.growthMillion, "with a volume of a million probes: 2 GB, minutes")
        ->excludes(without);
}

}  // namespace

void addBenchCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand("bench", "measure updates, queries and pictures against raw ray tracing");
    const auto options = std::make_shared<BenchOptions>();
    addOptions(*command, *options);
    command->footer(kFooter);
    command->callback([options, command, &exitCode] {
        checkOptions(*command, *options);
        if (const auto done = bench(*options); !done) exitCode = printError(done.error());
    });
}

}  // namespace probegi::tool
