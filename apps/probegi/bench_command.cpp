#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "bench_measure.h"
#include "bench_table.h"
#include "commands.h"
#include "output.h"
#include "parse.h"
#include "scene_setup.h"

namespace probegi::tool {

namespace {

struct BenchOptions {
    SceneOptions scene;
    std::string json;
    std::string size = "1920x1080";
    int rays = FieldDesc{}.raysPerProbe;
    int rounds = 5;
    bool noGrowth = false;
    bool growthMillion = false;
};

const char* const kFooter =
    R"(Measured in turn, round by round, so that a busy machine slows all of it alike; each ratio is taken within a round.
The floor is Embree alone with the rays of one update. A missed goal is printed, it is not a failure.

Example: probegi bench
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

Result<void> bench(const BenchOptions& options) {
    if (!options.json.empty())
        if (auto checked = checkOutput(options.json, {}); !checked) return checked;
    const auto setup = loadSetup(options.scene);
    if (!setup) return tl::unexpected(setup.error());
    const auto result = runBench(*setup, makePlan(options), showProgress);
    if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K");
    if (!result) return tl::unexpected(result.error());
    const std::string name = setup->scene->name.empty() ? options.scene.scene : setup->scene->name;
    fmt::print("{}", benchMarkdown(*result, name));
    return options.json.empty() ? Result<void>() : writeText(options.json, benchJson(*result, name));
}

void addOptions(CLI::App& command, BenchOptions& options) {
    options.scene.scene = "builtin:atrium";
    addSceneOptions(command, options.scene);
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
    command.add_option("--json", options.json, "write the figures there too")->type_name("FILE");
    auto* without = command.add_flag("--no-growth", options.noGrowth, "leave out the table of growing volumes");
    command.add_flag("--growth-million", options.growthMillion, "and a volume of a million probes: 2 GB, minutes")
        ->excludes(without);
}

}  // namespace

void addBenchCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand("bench", "measure updates, queries and pictures against raw ray tracing");
    const auto options = std::make_shared<BenchOptions>();
    addOptions(*command, *options);
    command->footer(kFooter);
    command->callback([options, &exitCode] {
        if (const auto done = bench(*options); !done) exitCode = printError(done.error());
    });
}

}  // namespace probegi::tool
