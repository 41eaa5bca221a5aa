#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "backend.h"
#include "budget.h"
#include "console/parse.h"
#include "console/terminal.h"
#include "contact.h"
#include "doors.h"
#include "events.h"
#include "flight.h"
#include "glossy.h"
#include "leak_sweep.h"
#include "markdown.h"
#include "motion.h"
#include "outside.h"
#include "placement.h"
#include "probegi/builtin_scenes.h"
#include "surfaces.h"

namespace {

using namespace probegi;
using namespace probegi::accuracy;

struct Options {
    std::string page;
    std::string only;   ///< a scene, or a table's name; empty: all
    std::string scene;  ///< of the placement's; empty: all
    bool leaky = false;
    std::string scenesFolder = "../shared/scenes";
    int threads = 0;
    int samplesPerPixel = 256;
    float updatesFrom = SweepDesc{}.finestUpdated;  ///< metres between probes; finer grids of the sweep converge only
};

/// A scene of the tables, as it would be passed to `probegi render`.
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
    settings.diffuseOnly = true;  // the field covers diffuse light only
    settings.seconds = 0;
    settings.samplesPerPixel = options.samplesPerPixel;
    settings.ratioProbes = 512;
    settings.realtimeUpdates = kRealtimeUpdates;
    return settings;
}

/// The table of irradiance at surfaces: the more complex of the scenes above, and two larger built-in ones.
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

/// The table of relocation and states.
Result<std::string> placement(const Context& context, const Options& options) {
    std::vector<PlacementRow> rows;
    for (const char* name : {"two-rooms", "house", "atrium", "sponza", "terrain"}) {
        if (!options.scene.empty() && options.scene != name) continue;
        tool::SceneOptions scene;
        scene.scene = "builtin:" + std::string(name);
        for (const Case& entry : cases(options))
            if (entry.name == name) scene = entry.options;
        const auto setup = tool::loadSetup(scene);
        if (!setup) return setup.error();
        const auto measured =
            measurePlacement(context, name, *setup, options.leaky ? LeakGuard::none : LeakGuard::moments);
        if (!measured) return measured.error();
        rows.insert(rows.end(), measured->begin(), measured->end());
    }
    return placementTable(rows);
}

/// A row of the table of light in motion.
struct MotionCase {
    std::string name;
    PlacementDesc placement;
    int rays = 0;
    MotionScope scope = MotionScope::changes;
    FieldRules rules = FieldRules::measured;
    std::string path{};  ///< empty: a built-in scene
    glm::vec3 sky{0.0f};
};

Result<MotionResult> measureMotion(const Context& context, const MotionCase& row) {
    tool::SceneOptions options;
    options.scene = row.path.empty() ? "builtin:" + row.name : row.path;
    auto loaded = tool::readScene(options);
    if (!loaded && !row.path.empty()) return MotionResult{.scene = row.name, .missing = loaded.error().message};
    if (!loaded) return loaded.error();
    if (!row.path.empty()) loaded->scene.sky.radiance = row.sky;
    FieldDesc desc;
    desc.raysPerProbe = row.rays;
    desc.rules = row.rules;
    const auto grid = placeVolume(poseAt(loaded->scene).bounds, row.placement);
    if (!grid) return grid.error();
    desc.volumes = {*grid};
    return measureMotion(context, row.name, loaded->scene, desc, row.scope);
}

/// The Cornell box on the grid of its tests with several numbers of rays, rooms lit from outside, and two scenes from
/// files, on grids coarse enough to finish in minutes.
Result<std::string> motion(const Context& context, const Options& options) {
    const PlacementDesc cornell{.counts = {8, 8, 8}}, rooms{.targetProbes = 1500}, coarse{.targetProbes = 700};
    const std::string sponza = options.scenesFolder + "/sponza/sponza.glb",
                      level = options.scenesFolder + "/openarena/oa_dm1.glb";
    const glm::vec3 sky(0.6f, 0.8f, 1.2f), none(0.0f);
    const int usual = FieldDesc{}.raysPerProbe;
    const auto still = MotionScope::still, changes = MotionScope::changes;
    std::vector<MotionCase> cases;
    for (const FieldRules rules : {FieldRules::paper, FieldRules::measured})
        for (const int rays : {64, 144, 512}) cases.push_back({"cornell", cornell, rays, changes, rules});
    for (const int rays : {64, usual, 512}) {
        const MotionScope scope = rays == usual ? changes : still;
        for (const char* name : {"house", "atrium"}) cases.push_back({name, rooms, rays, scope});
        cases.push_back({"sponza", coarse, rays, scope, FieldRules::measured, sponza, sky});
    }
    cases.push_back({"oa_dm1", coarse, usual, changes, FieldRules::measured, level, none});
    std::vector<MotionResult> rows;
    for (const MotionCase& row : cases) {
        auto measured = measureMotion(context, row);
        if (!measured) return measured.error();
        rows.push_back(std::move(*measured));
    }
    return motionTable(rows);
}

/// Reads a scene; `sky`: instead of its own, if not black.
Result<LoadedScene> sceneWithSky(const std::string& path, glm::vec3 sky) {
    tool::SceneOptions options;
    options.scene = path;
    auto loaded = tool::readScene(options);
    if (loaded && sky != glm::vec3(0.0f)) loaded->scene.sky.radiance = sky;
    return loaded;
}

constexpr glm::vec3 kSponzaSky(0.6f, 0.8f, 1.2f);

/// Flights through Sponza: small cascades on a plain machine, and the size of the paper's.
Result<std::string> flights(const Context& context, const Options& options) {
    std::vector<FlightResult> rows;
    const auto sponza = sceneWithSky(options.scenesFolder + "/sponza/sponza.glb", kSponzaSky);
    for (const auto& [counts, levels] : {std::pair(glm::ivec3(16, 10, 16), 3), std::pair(glm::ivec3(24, 12, 24), 4)}) {
        if (!sponza) {
            rows.push_back({.scene = "sponza", .missing = sponza.error().message});
            break;
        }
        FlightDesc desc;
        desc.cascades.counts = counts;
        desc.cascades.levels = levels;
        auto measured = measureFlight(context, "sponza", sponza->scene, desc);
        if (!measured) return measured.error();
        rows.push_back(std::move(*measured));
    }
    return flightTable(rows);
}

Result<std::string> outside(const Context& context, const Options& options) {
    std::vector<OutsideResult> rows;
    const auto add = [&](const char* name, const std::string& path, glm::vec3 sky) -> Result<void> {
        const auto loaded = sceneWithSky(path, sky);
        if (!loaded) {
            rows.push_back({.scene = name, .missing = loaded.error().message});
            return {};
        }
        auto measured = measureOutside(context, name, loaded->scene);
        if (!measured) return measured.error();
        rows.insert(rows.end(), measured->begin(), measured->end());
        return {};
    };
    const glm::vec3 own(0.0f);
    for (const char* name : {"two-rooms", "house", "atrium"})
        if (auto done = add(name, "builtin:" + std::string(name), own); !done) return done.error();
    if (auto done = add("sponza", options.scenesFolder + "/sponza/sponza.glb", kSponzaSky); !done) return done.error();
    if (auto done = add("oa_dm1", options.scenesFolder + "/openarena/oa_dm1.glb", own); !done) return done.error();
    return outsideTable(rows);
}

/// Updates with a budget, beside others.
Result<std::string> budgets(const Context& context, const Options& options) {
    std::vector<BudgetRow> rows;
    for (const char* name : {"cornell", "house"}) {
        if (!options.scene.empty() && options.scene != name) continue;
        const auto measured = measureBudget(context, name);
        if (!measured) return measured.error();
        rows.insert(rows.end(), measured->begin(), measured->end());
    }
    return budgetTable(rows);
}

/// All light of two scenes with metals or polished floors, and of one with neither.
Result<std::string> glossy(const Context& context, const Options& options) {
    std::vector<GlossyRow> rows;
    tool::SceneOptions mirrors, other, atrium, sponza;
    mirrors.scene = other.scene = "builtin:mirrors";
    other.camera = "mirror";
    atrium.scene = "builtin:atrium";
    for (const Case& entry : cases(options))
        if (entry.name == "sponza") sponza = entry.options;
    for (const auto& [name, scene] :
         {std::pair("mirrors", mirrors), {"mirrors, at a mirror", other}, {"atrium", atrium}, {"sponza", sponza}}) {
        if (!options.scene.empty() && options.scene != name) continue;
        const auto setup = tool::loadSetup(scene);
        if (!setup) {
            rows.push_back({.scene = name, .glossy = {}, .missing = setup.error().message});
            continue;
        }
        const auto measured = measureGlossy(context, name, *setup, options.samplesPerPixel);
        if (!measured) return measured.error();
        rows.insert(rows.end(), measured->begin(), measured->end());
    }
    return glossyTable(rows);
}

/// Contact light in scenes with nooks.
Result<std::string> contact(const Context& context, const Options& options) {
    std::vector<ContactRow> rows;
    for (const char* name : {"sponza", "house", "atrium", "desk"}) {
        if (!options.scene.empty() && options.scene != name) continue;
        tool::SceneOptions scene;
        scene.scene = "builtin:" + std::string(name);
        for (const Case& entry : cases(options))
            if (entry.name == name) scene = entry.options;
        const auto setup = tool::loadSetup(scene);
        if (!setup) {
            rows.push_back({.scene = name, .run = {}, .missing = setup.error().message});
            continue;
        }
        const auto measured = measureContact(context, name, *setup, options.samplesPerPixel);
        if (!measured) return measured.error();
        rows.insert(rows.end(), measured->begin(), measured->end());
    }
    return contactTable(rows);
}

Result<std::string> doors(const Context& context, const Options&) {
    const auto rows = measureDoors(context);
    return rows ? Result<std::string>(doorTable(*rows)) : rows.error();
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
    if (wanted("sweep")) {
        SweepDesc desc;
        desc.finestUpdated = options.updatesFrom;
        const auto rows = sweepLeaks(*context, desc);
        if (!rows) return rows.error();
        tables += sweepTables(*rows);
    }
    using Table = Result<std::string> (*)(const Context&, const Options&);
    for (const auto& [name, table] : {std::pair<const char*, Table>("surfaces", surfaces),
                                      {"placement", placement},
                                      {"motion", motion},
                                      {"budget", budgets},
                                      {"flight", flights},
                                      {"glossy", glossy},
                                      {"contact", contact},
                                      {"doors", doors},
                                      {"outside", outside}}) {
        if (!wanted(name)) continue;
        const auto made = table(*context, options);
        if (!made) return made.error();
        tables += *made;
    }
    if (wanted("events")) {
        const auto rows = measureEvents(*context);
        if (!rows) return rows.error();
        tables += eventTable(*rows);
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
    app.add_option(
           "--only", options.only,
           "print the tables of one scene, the leak, its sweep, the surfaces, placement, motion, budgets, events, "
           "a flight, what is outside of volumes, glossy or contact light, or masks at a door, and write nothing")
        ->type_name(
            "cornell|two-rooms|dark-room|sponza|leak|sweep|surfaces|placement|motion|budget|events|flight|outside|"
            "glossy|contact|doors");
    app.add_option("--scene", options.scene, "of placement, budget, glossy and contact: this scene only");
    app.add_flag("--leaky", options.leaky, "placement: without a visibility test");
    app.add_option("--scenes", options.scenesFolder, "folder of the real scenes (default: PROBEGI_SCENES)")
        ->capture_default_str();
    app.add_option("--threads", options.threads, "worker threads; 0: all")->check(tool::inRange(0, 1024));
    app.add_option("--updates-from", options.updatesFrom,
                   "sweep: finer grids than this are converged, but not filled by updates, metres")
        ->check(tool::inRange(0, 1e6))
        ->capture_default_str();
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
