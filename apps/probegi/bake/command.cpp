#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "bake/report.h"
#include "commands.h"
#include "console/output.h"
#include "console/parse.h"
#include "sdf_scene.h"

namespace probegi::tool {

namespace {

const char* const kFooter =
    R"(Fills the probes, bakes masks for the look-ups (--leak-guard moments leaves these out), and writes both into one file
(docs/field_file.md). 'probegi render SCENE --field FILE' draws with it at once, 'probegi info FILE' tells what is in it,
'probegi compare A B' how two differ, and loadField() reads it into an engine. Lights may change without another bake:
'render --field FILE --frames N' lets the probes follow. Equal options and seeds give equal files.

Primitives are not kept: for their shadows give 'render --field FILE' --sdf and --leak-guard sdf-shadow.

While it works, FILE.part keeps what there is so far, every --checkpoint seconds; where that file is, --resume goes on
from there with the same options, and ends with the same file.

Example: probegi bake builtin:house -o house.field
Example: probegi bake sponza.glb -o sponza.field --sky 0.3,0.4,0.6 --probes 64x32x64 --checkpoint 300
Example: probegi bake builtin:dark-room -o dark.field --clusters 6 --strict --stats bake.json)";

Result<void> bake(BakeOptions& options) {
    RenderOptions& render = options.render;
    Outputs outputs;
    if (auto claimed = outputs.claim("-o", render.output); !claimed) return claimed;
    if (const std::string part = partFileOf(render.output); !part.empty())
        if (auto claimed = outputs.claim("FILE.part of -o", part); !claimed) return claimed;
    if (!render.stats.empty())
        if (auto claimed = outputs.claim("--stats", render.stats); !claimed) return claimed;
    const auto context = makeContext(render.scene.threads);
    if (!context) return context.error();
    const auto backend = openBackend(*context, render.backend);
    if (!backend) return backend.error();
    const auto setup = loadSetup(render.scene);
    if (!setup) return setup.error();
    if (auto apart = outputs.keepApartFrom(setup->files); !apart) return apart;
    const auto tracer = (*backend)->openScene(*setup->scene, setup->pose);
    if (!tracer) return tracer.error();
    const auto primitives = openProbeTracer(**backend, *setup, setup->pose);
    if (!primitives) return primitives.error();
    const auto report =
        Baking(*context, **backend, *setup, options, **tracer, *primitives ? **primitives : **tracer).run();
    if (!report) return report.error();
    if (!render.stats.empty())
        if (auto written = writeText(render.stats, bakeJson(*report, options, *setup)); !written) return written;
    std::error_code none;
    for (const std::string& file : {render.output, render.stats})
        if (std::filesystem::equivalent(file, "/dev/stdout", none)) return {};
    fmt::print("{}", bakeText(*report, options, *setup));
    return {};
}

void addBakeOptions(CLI::App& command, BakeOptions& options) {
    command.add_option("-o,--output", options.render.output, "the file to write, e.g. scene.field")
        ->type_name("FILE")
        ->required();
    command.add_flag("--resume", options.resume, "go on from FILE.part, which a bake that did not end has left");
    command
        .add_option("--checkpoint", options.checkpointSeconds,
                    "how often FILE.part is written, 0 (after each update) to 86400")
        ->type_name("SECONDS")
        ->check(inRange(0, 86400))
        ->capture_default_str();
    command.add_option("--stats", options.render.stats, "write what was baked, seconds and memory as JSON")
        ->type_name("FILE");
    command
        .add_option("--seed", options.render.seed, "random seed of rays and clusters; equal seeds give equal fields")
        ->type_name("N")
        ->check(wholeNumber())
        ->capture_default_str();
}

}  // namespace

void addBakeCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand("bake", "fill a scene's probes, bake masks, and keep both in a file");
    const auto options = std::make_shared<BakeOptions>();
    options->render.masks.guard = LeakGuard::masks;
    addBakeOptions(*command, *options);
    addProbeOptions(*command, options->render);
    addSdfOption(*command, options->render.scene);
    addMaskOptions(*command, options->render.masks, {.shortNames = true});
    addFieldRunOptions(*command, options->render.run);
    addBackendOptions(*command, options->render.backend);
    addSceneOptions(*command, options->render.scene);
    command->footer(kFooter);
    command->callback([options, command, &exitCode] {
        checkBackendOptions(*command, options->render.backend);
        checkMaskOptions(options->render.masks, options->render.scene.volumes);
        if (const auto done = bake(*options); !done) exitCode = printError(done.error());
    });
}

}  // namespace probegi::tool
