#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "backend.h"
#include "markdown.h"
#include "motion.h"
#include "parse.h"
#include "probegi/builtin_scenes.h"
#include "surface_points.h"
#include "terminal.h"

namespace {

using namespace probegi;
using namespace probegi::accuracy;

struct Options {
    std::string page;
    std::string only;  ///< a scene, "leak" or "surfaces"; empty: all
    std::string scenesFolder = "../shared/scenes";
    int threads = 0;
    int samplesPerPixel = 256;
};

/// A scene of the tables, as one would give it to `probegi render`.
struct Case {
    std::string name;
    tool::SceneOptions options;
};

std::vector<Case> cases(const Options& options) {
    std::vector<Case> list;
    const auto add = [&](const char* name, const std::string& scene, const char* camera, const char* sky) {
        Case entry{name, {}};
        entry.options.scene = scene;
        entry.options.camera = camera;
        entry.options.sky = sky;
        list.push_back(std::move(entry));
    };
    add("cornell", "builtin:cornell", "", "");
    add("two-rooms", "builtin:two-rooms", "second", "");
    add("dark-room", "builtin:dark-room", "lit", "");
    add("sponza", options.scenesFolder + "/sponza/sponza.glb", "nave", "0.6,0.8,1.2");
    return list;
}

tool::ReportSettings settingsOf(const Options& options) {
    tool::ReportSettings settings;
    settings.width = 480;
    settings.height = 270;
    settings.diffuseOnly = true;  // what the field promises; gloss is another matter
    settings.seconds = 0;
    settings.samplesPerPixel = options.samplesPerPixel;
    settings.ratioProbes = 512;
    settings.realtimeUpdates = kRealtimeUpdates;
    return settings;
}

/// The table of irradiance at surfaces: the scenes above that have much to see, and two larger built-in ones.
Result<std::string> surfaces(const Context& context, const Options& options) {
    std::vector<SurfaceRow> rows;
    for (const char* name : {"cornell", "house", "atrium", "sponza"}) {
        tool::SceneOptions scene;
        scene.scene = "builtin:" + std::string(name);
        for (const Case& entry : cases(options))
            if (entry.name == name) scene = entry.options;
        const auto setup = tool::loadSetup(scene);
        if (!setup) return setup.error();
        const auto measured = measureSurface(context, name, *setup, true);
        if (!measured) return measured.error();
        rows.insert(rows.end(), measured->begin(), measured->end());
    }
    return surfaceTable(rows);
}

/// The Cornell box on the grid of its tests at several numbers of rays, and rooms lit from outside.
Result<std::string> motion(const Context& context) {
    std::vector<MotionResult> rows;
    const auto add = [&](const char* name, const PlacementDesc& placement, int rays, FieldRules rules) -> Result<void> {
        const auto scene = makeBuiltinScene(name);
        if (!scene) return scene.error();
        FieldDesc desc;
        desc.raysPerProbe = rays;
        desc.rules = rules;
        const auto grid = placeGrid(poseAt(*scene).bounds, placement);
        if (!grid) return grid.error();
        desc.grid = *grid;
        auto measured = measureMotion(context, name, *scene, desc);
        if (!measured) return measured.error();
        rows.push_back(std::move(*measured));
        return {};
    };
    const PlacementDesc cornell{.counts = {8, 8, 8}}, other{.targetProbes = 1500};
    for (const FieldRules rules : {FieldRules::paper, FieldRules::measured})
        for (const int rays : {64, 144, 512})
            if (auto done = add("cornell", cornell, rays, rules); !done) return done.error();
    for (const char* name : {"house", "atrium"})
        if (auto done = add(name, other, FieldDesc{}.raysPerProbe, FieldRules::measured); !done) return done.error();
    return motionTable(rows);
}

Result<void> measure(const Options& options) {
    const auto context = tool::makeContext(options.threads);
    if (!context) return context.error();
    const auto backend = tool::openBackend(*context, {});
    if (!backend) return backend.error();
    std::vector<MeasuredScene> scenes;
    const auto wanted = [&](const std::string& name) { return options.only.empty() || options.only == name; };
    for (const Case& entry : cases(options)) {
        if (!wanted(entry.name)) continue;
        const auto setup = tool::loadSetup(entry.options);
        if (!setup) return setup.error();
        auto rendered = tool::renderForReport(*context, **backend, *setup, settingsOf(options));
        if (!rendered) return rendered.error();
        scenes.push_back({entry.name, std::move(*rendered)});
    }
    std::vector<LeakResult> leaks;
    for (const float thickness : {0.02f, 0.05f, 0.10f, 0.20f, 0.30f}) {
        if (!wanted("leak")) break;
        const auto leak = measureLeak(*context, thickness);
        if (!leak) return leak.error();
        leaks.push_back(*leak);
    }
    std::string tables = accuracyTables(scenes, leaks, context->threads());
    if (wanted("surfaces")) {
        const auto table = surfaces(*context, options);
        if (!table) return table.error();
        tables += *table;
    }
    if (wanted("motion")) {
        const auto table = motion(*context);
        if (!table) return table.error();
        tables += *table;
    }
    if (!options.page.empty() && options.only.empty()) return replaceBetweenMarkers(options.page, tables);
    fmt::print("{}", tables);
    return {};
}

int run(int argc, char** argv) {
    CLI::App app("Measures the tables of docs/accuracy.md", "probegi_accuracy");
    Options options;
    if (const char* folder = std::getenv("PROBEGI_SCENES"); folder && *folder) options.scenesFolder = folder;
    app.add_option("-o,--output", options.page, "page whose measured part is replaced (default: print)")
        ->type_name("FILE");
    app.add_option("--only", options.only,
                   "print the tables of one scene, the leak, the surfaces or motion, and write nothing")
        ->type_name("cornell|two-rooms|dark-room|sponza|leak|surfaces|motion");
    app.add_option("--scenes", options.scenesFolder, "folder of the real scenes (default: PROBEGI_SCENES)")
        ->capture_default_str();
    app.add_option("--threads", options.threads, "worker threads; 0: all")->check(tool::inRange(0, 1024));
    app.add_option("--spp", options.samplesPerPixel, "samples a pixel of the reference")
        ->check(tool::inRange(1, 1e6))
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    const auto done = measure(options);
    return done ? 0 : tool::printError(done.error());
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        return tool::printError({ErrorCode::outOfMemory, error.what()});
    }
}
