#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "commands.h"
#include "console/output.h"
#include "console/parse.h"
#include "console/terminal.h"
#include "report/page.h"

namespace probegi::tool {

namespace {

namespace fs = std::filesystem;

struct ReportOptions {
    SceneOptions scene;
    BackendOptions backend;
    std::vector<std::string> more;
    std::string folder, size = "960x540";
    bool plain = false;
    std::optional<double> seconds;
    std::optional<int> samplesPerPixel;
    ReportSettings settings;
};

const char* const kFooter =
    R"(Writes DIR/report.html, one page that needs nothing else, and beside it the pictures as PNG and EXR and the numbers
as report.json. The page begins with a verdict: whether the field matches the reference, where it leaks, or that the
reference is too noisy to tell. All cameras of a scene are drawn, all but the first at half the size, unless --camera
or --look-from names one. Options apply
to all scenes; the reference is path traced on the CPU whatever the backend. Errors are measured on light that clips at
white, whatever the pictures are shown with.

Example: probegi report builtin:atrium -o out
Example: probegi report builtin:cornell sponza.glb -o out --size 1280x720 --time 60)";

/// The letters, digits, - and _ of the scene's name, which are safe in file names on all systems.
std::string filePrefix(const std::string& scene, std::set<std::string>& taken) {
    std::string name = scene.rfind("builtin:", 0) == 0 ? scene.substr(8) : fs::path(scene).stem().string();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
    if (name.empty()) name = "scene";
    std::string unique = name;
    for (int number = 2; !taken.insert(unique).second; ++number) unique = fmt::format("{}-{}", name, number);
    return unique;
}

/// The command line as given, so that readers can reproduce the page.
std::string commandLine(const CLI::App& command) {
    std::string line = "probegi " + command.get_name();
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        if (!option->get_positional()) line += " " + option->get_name();
        if (option->get_expected_max() == 0) continue;
        for (const std::string& value : option->results()) line += " " + value;
    }
    return line;
}

/// The scene's name for readers: the file name without folders.
std::string sceneTitle(const std::string& scene) {
    return scene.rfind("builtin:", 0) == 0 ? scene : plainText(fs::path(scene).filename().string());
}

ReportSettings settingsOf(const ReportOptions& options) {
    ReportSettings settings = options.settings;
    const PictureSize size = *parseSize(options.size);
    settings.width = size.width;
    settings.height = size.height;
    settings.samplesPerPixel = options.samplesPerPixel.value_or(0);
    settings.seconds = options.seconds.value_or(options.samplesPerPixel ? 0 : settings.seconds);
    settings.allCameras =
        options.scene.camera.empty() && options.scene.lookFrom.empty() && options.scene.lookAt.empty();
    return settings;
}

/// Whether the name of a file is one that a scene's pictures could have.
bool isPictureOf(const std::string& prefix, const fs::path& folder, const fs::path& file) {
    std::error_code error;
    const std::string extension = file.extension().string();
    const fs::path beside = file.has_parent_path() ? file.parent_path() : fs::path(".");
    return (extension == ".png" || extension == ".exr") && file.filename().string().starts_with(prefix + "-") &&
           fs::equivalent(beside, folder, error);
}

/// Creates the folder, and checks that the page's files would not overwrite the scenes'.
Result<void> makeFolder(const fs::path& folder, const std::vector<LoadedSetup>& setups,
                        const std::vector<std::string>& prefixes) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        return fail(ErrorCode::writeFailed,
                    fmt::format("The folder '{}' cannot be created ({}): choose another with -o", folder.string(),
                                error.message()));
    Outputs outputs;
    for (const char* name : {"report.html", "report.json"})
        if (auto claimed = outputs.claim("-o", folder / name); !claimed) return claimed;
    for (const LoadedSetup& setup : setups)
        if (auto apart = outputs.keepApartFrom(setup.files); !apart) return apart;
    for (const LoadedSetup& setup : setups)
        for (const fs::path& file : setup.files)
            for (const std::string& prefix : prefixes)
                if (isPictureOf(prefix, folder, file))
                    return fail(ErrorCode::invalidArgument,
                                fmt::format("a picture of the report could overwrite '{}', which is read; choose "
                                            "another folder with -o",
                                            file.string()));
    return {};
}

const std::string& sceneName(const ReportOptions& options, std::size_t scene) {
    return scene == 0 ? options.scene.scene : options.more[scene - 1];
}

/// Sets up one progress bar over all pictures of all scenes.
void planProgress(const std::vector<LoadedSetup>& setups, ReportSettings& settings, WholeBar& bar) {
    std::vector<double> guesses;
    for (const LoadedSetup& setup : setups)
        for (const ReportPiece& piece : reportPieces(setup, settings)) guesses.push_back(piece.seconds);
    bar.plan(std::move(guesses));
    settings.onPiece = [&bar](const std::string& piece) { bar.begin(piece); };
    settings.run.progress = [&bar](double share) { bar.done(share); };
}

/// Loads all scenes before the work begins, so that a mistyped name is reported at once.
Result<std::vector<LoadedSetup>> loadAll(const ReportOptions& options) {
    std::vector<LoadedSetup> setups;
    SceneOptions one = options.scene;
    std::vector<std::string> names{options.scene.scene};
    names.insert(names.end(), options.more.begin(), options.more.end());
    for (const std::string& name : names) {
        one.scene = name;
        auto setup = loadSetup(one);
        if (!setup) return setup.error();
        setups.push_back(std::move(*setup));
    }
    return setups;
}

/// The figures of a scene that are printed; the page has the rest.
std::string keyNumbers(const std::string& name, const RenderedScene& scene) {
    const FieldResult& field = scene.ddgiField;
    const LightRatio& ratio = scene.ddgi.whole.difference.ratio;
    return fmt::format(
        "{}: {}\n"
        "  {} probes, {:.0f} ms an update ({})\n"
        "  light over the path tracer's: {:.3f} at the median of {} probes, {:.3f} in the picture (blocks {:.3f} to "
        "{:.3f})\n"
        "  FLIP error: {:.3f} without GI, {:.3f} with the field; an exact picture {:.3f} for the reference's noise\n",
        plainText(name), verdictOf(scene).sentence, probeCount(scene.grid), field.update.total, field.description,
        field.ratio.median, scene.truth.probes.size(), ratio.mean, ratio.low, ratio.high,
        scene.none.whole.difference.flip, scene.ddgi.whole.difference.flip, scene.noiseFloor.flip);
}

Result<void> writeReport(const ReportOptions& options, const CLI::App& command) {
    const fs::path folder(options.folder);
    WholeBar bar;
    const auto context = makeContext(options.scene.threads, bar);
    if (!context) return context.error();
    const auto backend = openBackend(*context, options.backend);
    if (!backend) return backend.error();
    const auto setups = loadAll(options);
    if (!setups) return setups.error();
    std::set<std::string> taken;
    std::vector<std::string> prefixes;
    for (std::size_t i = 0; i < setups->size(); ++i) prefixes.push_back(filePrefix(sceneName(options, i), taken));
    if (auto made = makeFolder(folder, *setups, prefixes); !made) return made;
    ReportSettings settings = settingsOf(options);
    planProgress(*setups, settings, bar);

    Report report{"ProbeGI report", plainText(commandLine(command)), legendColours(), {}};
    nlohmann::json numbers = nlohmann::json::array();
    std::string summary;
    for (std::size_t i = 0; i < setups->size(); ++i) {
        const std::string& name = sceneName(options, i);
        const LoadedSetup& setup = (*setups)[i];
        const auto rendered = renderForReport(*context, **backend, setup, settings);
        if (!rendered) return rendered.error();
        auto section = describeScene(*rendered, {folder, prefixes[i], sceneTitle(name)}, !options.plain);
        if (!section) return section.error();
        report.scenes.push_back(std::move(*section));
        numbers.push_back(sceneNumbers(*rendered));
        numbers.back()["scene"] = name;
        summary += keyNumbers(name, *rendered);
    }
    if (auto written = writeText(folder / "report.json", jsonText(numbers)); !written) return written;
    if (auto written = writeText(folder / "report.html", reportHtml(report)); !written) return written;
    bar.clear();
    fmt::print("{}{}\n", summary, plainText((folder / "report.html").string()));
    return {};
}

void addReportOptions(CLI::App& command, ReportOptions& options) {
    command.add_option("MORE", options.more, "further scenes for the same page")->type_name("");
    command.add_option("-o,--output", options.folder, "folder for the page and its pictures; created if missing")
        ->type_name("DIR")
        ->required();
    command.add_option("--size", options.size, "pixels, each side 1 to 16384")
        ->type_name("WxH")
        ->check(parsedBy(parseSize))
        ->capture_default_str();
    command
        .add_option(
            "--time", options.seconds,
            fmt::format("reference: seconds for the first camera, a quarter for each other (default {} without --spp)",
                        options.settings.seconds))
        ->type_name("SECONDS")
        ->check(inRange(0.001, 1e6));
    command.add_option("--spp", options.samplesPerPixel, "reference: samples per pixel")
        ->type_name("N")
        ->check(inRange(1, 1e6));
    command.add_option("--rays", options.settings.raysPerProbe, "rays per probe and update, 8 to 4096")
        ->type_name("N")
        ->check(inRange(8, 4096))
        ->capture_default_str();
    addFieldRunOptions(command, options.settings.run);
    command
        .add_option("--ratio-probes", options.settings.ratioProbes,
                    "probes that are compared with the reference, 1 to 65536")
        ->type_name("N")
        ->check(inRange(1, 65536))
        ->capture_default_str();
    command.add_flag("--plain", options.plain, "show pictures clipped at white, without a smooth shoulder");
    command.add_flag("--diffuse-only", options.settings.diffuseOnly,
                     "all materials as matt surfaces of their base colour");
    command.add_option("--seed", options.settings.seed, "random seed; equal seeds give equal pictures")
        ->type_name("N")
        ->check(wholeNumber())
        ->capture_default_str();
}

}  // namespace

void addReportCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand("report", "no GI, field and reference side by side in one web page");
    const auto options = std::make_shared<ReportOptions>();
    addSceneOptions(*command, options->scene);
    addReportOptions(*command, *options);
    addBackendOptions(*command, options->backend);
    command->footer(kFooter);
    command->callback([options, command, &exitCode] {
        checkBackendOptions(*command, options->backend);
        if (const auto done = writeReport(*options, *command); !done) exitCode = printError(done.error());
    });
}

}  // namespace probegi::tool
