#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "animation/animate.h"
#include "animation/video_file.h"
#include "commands.h"
#include "console/output.h"
#include "console/parse.h"
#include "debug_view.h"
#include "render_options.h"
#include "render_stats.h"
#include "saved_field.h"
#include "sdf_scene.h"

namespace probegi::tool {

namespace {

const char* const kFooter =
    R"(Light is in linear Rec.709: radiance in W/sr/m2, irradiance in W/m2; lengths in metres; +Y is up.
An .exr holds the linear values; a .png is 8-bit sRGB after --exposure, dithered. Without --exposure each .png gets an
exposure of its own, which is told: give it to the next picture where two are to be compared by eye.
As .png, normals are 0.5 + 0.5 n, depth fades to black at the farthest point, irradiance is what a white matt surface
would send back.

Example: probegi render builtin:cornell -o cornell.png
Example: probegi render builtin:cornell -o darker.png --exposure 0.8
Example: probegi render sponza.glb -o sponza.exr --camera nave --sky 0.3,0.4,0.6 --size 1920x1080 --stats stats.json
Example: probegi render builtin:house -o house.png --backend vulkan
Example: probegi render builtin:mirrors -o mirrors.png --glossy field
Example: probegi render builtin:desk -o desk.png --contact on
Example: probegi render builtin:dark-room -o dark.png --camera dark --leak-guard masks --stats masks.json
Example: probegi render sponza.glb -o near.png --camera nave --sky 0.3,0.4,0.6 --cascades 4
Example: probegi render sponza.glb -o seams.png --camera nave --sky 0.3,0.4,0.6 --cascades 4 --debug volumes
Example: probegi render builtin:house -o house.png --sdf house.sdf.json
Example: probegi render builtin:house -o house.png --sdf house.sdf.json --method sdfddgi
Example: probegi render builtin:house -o house.png --field house.field
Example: probegi render builtin:house -o house.png --field house.field --sdf house.sdf.json --leak-guard sdf-shadow
Example: probegi render builtin:house -o truth.png --method reference --time 30
Example: probegi render builtin:door -o door%03d.png --animate 0:4:0.1 --camera second
Example: probegi render builtin:moving -o moving.mp4 --animate 0:4:0.04 --camera tracking
Example: probegi render builtin:moving -o moving.mp4 --animate 0:4:0.04 --camera tracking --budget 40000

--animate fills the probes by 100 real-time updates (--frames) before the first picture; all pictures get one exposure,
chosen from five of them. With --method reference, --spp and --time are for each picture.)";

/// What rays hit: those of pictures, and those of probes if it is something else (--sdf). And what probes begin with.
struct Tracers {
    const Tracer& pictures;
    const Tracer* primitives;
    const SavedField* saved;  ///< of --field; null: none

    const Tracer& probes() const { return primitives ? *primitives : pictures; }
};

Result<std::optional<Field>> takeUp(const Backend& backend, const SavedField& saved, const LoadedSetup& setup,
                                    const RenderOptions& options) {
    auto field = openSavedField(backend, saved, options.method);
    if (!field) return field.error();
    if (auto set = setBudget(*field, setup, options); !set) return set.error();
    if (options.masks.guard != LeakGuard::sdfShadow) return std::move(*field);
    FieldSettings settings = field->control().settings();
    settings.guard = LeakGuard::sdfShadow;
    if (auto placed = placeGuard(settings, setup, setup.pose); !placed) return placed.error();
    if (auto set = field->control().setSettings(settings); !set) return set.error();
    return std::move(*field);
}

Result<std::optional<Field>> makeField(const Context& context, const Backend& backend, const Tracers& tracers,
                                       const LoadedSetup& setup, const RenderOptions& options, RenderStats& stats) {
    auto field = tracers.saved ? takeUp(backend, *tracers.saved, setup, options)
                               : makeEmptyField(backend, setup, options, setup.pose);
    if (!field || !*field) return field;
    stats.probes = probeCount((*field)->desc());
    stats.raysPerProbe = (*field)->desc().raysPerProbe;
    if (options.masks.bakes()) {
        if (auto baked = bakeMasksFor(**field, context, tracers.pictures, setup, options.masks); !baked)
            return baked.error();
    }
    if (const auto& masks = (*field)->control().settings().masks) stats.masks = masks->report();
    if (tracers.saved && !updatesSaved(options)) {
        stats.active = int((*field)->control().tasks().size());
        return field;
    }
    if (!options.debug.empty() && !findDebugView(options.debug)->needsLight) return field;
    auto run = runField(**field, tracers.probes(), setup.lighting, options.run);
    if (!run) return run.error();
    stats.run = std::move(*run);
    if (auto unlimited = (*field)->control().setBudget({}); !unlimited) return unlimited.error();
    stats.active = int((*field)->control().tasks().size());
    return field;
}

Result<Picture> drawWithField(const Context& context, const Backend& backend, const Tracers& tracers,
                              const LoadedSetup& setup, const RenderOptions& options, RenderStats& stats) {
    const auto field = makeField(context, backend, tracers, setup, options, stats);
    if (!field) return field.error();
    const auto renderer = backend.makeRenderer();
    if (!renderer) return renderer.error();
    auto rendered =
        (*renderer)->render(tracers.pictures, setup.lighting, *field ? &**field : nullptr, pictureDesc(options, setup));
    if (!rendered) return rendered.error();
    stats.pictureMs = rendered->times.total;
    if (options.glossy != Glossy::off) stats.glossyMs = rendered->times.glossy;
    if (options.contact) stats.contactMs = rendered->times.contact;
    return std::move(rendered->picture);
}

Result<Picture> drawReference(const Context& context, const Backend& backend, const Tracers& tracers,
                              const LoadedSetup& setup, const RenderOptions& options, RenderStats& stats) {
    const auto field = makeField(context, backend, tracers, setup, options, stats);
    if (!field) return field.error();
    auto rendered = renderReference(context, tracers.pictures, setup, options, *field ? &**field : nullptr);
    if (!rendered) return rendered.error();
    stats.pictureMs = rendered->seconds * 1000;
    return std::move(rendered->picture);
}

Result<void> renderDebugView(const Context& context, const Backend& backend, const Tracers& tracers,
                             const LoadedSetup& setup, const RenderOptions& options, RenderStats& stats) {
    auto field = makeField(context, backend, tracers, setup, options, stats);
    if (!field) return field.error();
    const PictureSize size = *parseSize(options.size);
    const auto image = drawDebugView(*findDebugView(options.debug), **field, tracers.pictures, tracers.primitives,
                                     setup.camera, size.width, size.height);
    if (!image) return image.error();
    return writeImage(options.output, *image);
}

void warnAboutUnusedOptions(const RenderOptions& options) {
    const bool reference = options.method == Method::reference;
    if (!reference && (options.samplesPerPixel || options.seconds || options.guide))
        printWarning("--spp, --time and --guide act on --method reference only");
    if (options.glossy != Glossy::off && (reference || options.diffuseOnly))
        printWarning("--glossy does nothing with --method reference and with --diffuse-only");
    if (options.contact && reference) printWarning("--contact does nothing with --method reference");
    if (!options.debug.empty() && (options.glossy != Glossy::off || options.contact))
        printWarning("--glossy and --contact do nothing with --debug");
    const bool probes = hasProbes(options);
    if (!probes && (options.run.frames || options.run.tolerance))
        printWarning("--frames and --tolerance act on --method ddgi and leaky, and on --guide on, only");
    if (!probes && (options.relocation || options.probeStates))
        printWarning("--relocation and --probe-states act on --method ddgi and leaky only");
    if (!probes && !options.scene.sdf.empty()) printWarning("--sdf acts on --method ddgi and leaky only");
    if (!probes && options.rules == FieldRules::paper) printWarning("--rules acts on --method ddgi and leaky only");
    if (!options.animate.empty() && options.run.tolerance)
        printWarning("--tolerance acts on single pictures only; --frames says how --animate fills the probes");
    if ((options.animate.empty() || !probes) && (options.updatesPerFrame || !options.events))
        printWarning("--updates-per-frame and --events act on the probes of --animate only");
}

/// --method sdfddgi is --method ddgi with what the SDFDDGI paper has, where the command line does not say otherwise.
void applyPreset(const CLI::App& command, RenderOptions& options) {
    if (options.method != Method::sdfddgi) return;
    if (options.scene.sdf.empty())
        throw CLI::ValidationError("--method", "sdfddgi needs the primitives of --sdf FILE, which 'probegi fit' makes");
    options.method = Method::ddgi;
    const auto given = [&](const char* name) { return command.get_option(name)->count() > 0; };
    if (!given("--leak-guard")) options.masks.guard = LeakGuard::sdfShadow;
    if (!given("--relocation")) options.relocation = true;
    if (!given("--contact")) options.contact = options.debug.empty();
}

void checkOptions(const CLI::App& command, const RenderOptions& options) {
    checkBackendOptions(command, options.backend);
    checkMaskOptions(options.masks, options.scene.volumes);
    if (options.masks.bakes() && options.method != Method::ddgi)
        throw CLI::ValidationError("--leak-guard", "masks are looked up with --method ddgi only");
    if (options.masks.guard == LeakGuard::sdfShadow && options.scene.sdf.empty())
        throw CLI::ValidationError("--leak-guard", "sdf-shadow needs the primitives of --sdf FILE");
    if (options.masks.guard == LeakGuard::sdfShadow && options.method != Method::ddgi)
        throw CLI::ValidationError("--leak-guard", "shadows of primitives are tested with --method ddgi only");
    if (options.scene.probesHitMesh && options.scene.sdf.empty())
        throw CLI::ValidationError("--probe-rays", "they hit the mesh anyway without --sdf FILE");
    const bool glossy = options.glossy != Glossy::off && options.method != Method::reference && !options.diffuseOnly;
    if (options.aov == Aov::glossy && !glossy)
        throw CLI::ValidationError("--aov",
                                   "this picture has no glossy layer; it takes --glossy first or field, and "
                                   "neither --method reference nor --diffuse-only");
    const bool contact = options.contact && options.method != Method::reference;
    if ((options.aov == Aov::contact || options.aov == Aov::openness) && !contact)
        throw CLI::ValidationError(
            "--aov", "this picture has no contact layers; they take --contact on, and not --method reference");
    if (!options.debug.empty() && (options.method == Method::none || options.method == Method::reference))
        throw CLI::ValidationError("--debug", "--method none and reference have no probes to show");
    if (!options.debug.empty() && findDebugView(options.debug)->primitives && options.scene.sdf.empty())
        throw CLI::ValidationError("--debug", "sdf shows the primitives of --sdf FILE");
    if (!options.field.empty() && (!hasProbes(options) || !options.animate.empty()))
        throw CLI::ValidationError("--field",
                                   "it has probes for --method ddgi and leaky, and --guide on, of a single picture");
    // Of --method sdfddgi or by itself.
    if (!options.field.empty() && options.masks.guard != LeakGuard::sdfShadow &&
        command.get_option("--leak-guard")->count() > 0)
        throw CLI::ValidationError("--leak-guard",
                                   "the file of --field says whether it is moments or masks; with it give sdf-shadow "
                                   "and --sdf, --method leaky, or nothing");
    if (options.masks.budget > 0 && options.animate.empty())
        throw CLI::ValidationError("--mask-budget", "it limits what masks of moving things may take: give --animate");
    if (!options.budget.empty() && (!hasProbes(options) || (options.animate.empty() && !options.run.frames)))
        throw CLI::ValidationError("--budget", "it limits the real-time updates of probes: give --frames or --animate");
    if (options.method == Method::reference && options.backend.kind == BackendKind::vulkan)
        throw CLI::ValidationError("--backend", "--method reference is path traced on the CPU only");
}

Result<void> render(const RenderOptions& given) {
    RenderOptions options = given;
    warnAboutUnusedOptions(options);
    if (!options.animate.empty()) return renderAnimation(options);
    Outputs outputs;
    if (isVideo(options.output))
        return fail(ErrorCode::unsupported,
                    fmt::format("-o '{}' is a video, which --animate A:B:STEP makes; one picture "
                                "must end in {}",
                                options.output, fmt::join(pictureExtensions(), " or ")));
    if (auto claimed = outputs.claim("-o", options.output, pictureExtensions()); !claimed) return claimed;
    if (!options.stats.empty())
        if (auto claimed = outputs.claim("--stats", options.stats); !claimed) return claimed;
    const auto context = makeContext(options.scene.threads);
    if (!context) return context.error();
    const auto backend = openBackend(*context, options.backend);
    if (!backend) return backend.error();
    const auto saved = readSavedField(options);
    if (!saved) return saved.error();
    const auto setup = loadSetup(options.scene);
    if (!setup) return setup.error();
    if (auto apart = outputs.keepApartFrom(setup->files); !apart) return apart;
    if (*saved) {
        if (auto apart = outputs.keepApartFrom({options.field}); !apart) return apart;
        if (auto told = warnOfOtherScene(**saved, *setup, updatesSaved(options)); !told) return told;
    }
    const auto tracer = (*backend)->openScene(*setup->scene, setup->pose);
    if (!tracer) return tracer.error();
    const auto primitives = openProbeTracer(**backend, *setup, setup->pose);
    if (!primitives) return primitives.error();
    const Tracers tracers{**tracer, primitives->get(), *saved ? &**saved : nullptr};

    RenderStats stats;
    stats.sdf = setup->sdf;
    if (!options.debug.empty()) {
        if (auto drawn = renderDebugView(*context, **backend, tracers, *setup, options, stats); !drawn) return drawn;
        return options.stats.empty() ? Result<void>() : writeText(options.stats, statsJson(stats));
    }
    const auto draw = options.method == Method::reference ? drawReference : drawWithField;
    const auto picture = draw(*context, **backend, tracers, *setup, options, stats);
    if (!picture) return picture.error();
    const ToneMap toneMap{shownExposure(*setup, picture->color), options.filmic};
    if (auto written = writeAov(options.output, *picture, options.aov, toneMap); !written) return written;
    if (!options.stats.empty())
        if (auto written = writeText(options.stats, statsJson(stats)); !written) return written;
    // Print nothing else if the statistics go to standard output, which a program then reads.
    std::error_code none;
    if (setup->automaticExposure && isLight(options.aov) && options.output.ends_with(".png") &&
        !std::filesystem::equivalent(options.stats, "/dev/stdout", none))
        fmt::print("exposure {:.4g}, chosen automatically; for the same in other pictures: --exposure {:.4g}\n",
                   toneMap.exposure, toneMap.exposure);
    return {};
}

void addPictureOptions(CLI::App& command, RenderOptions& options) {
    static const std::map<std::string, Aov> kAovs{{"color", Aov::color},       {"irradiance", Aov::irradiance},
                                                  {"normal", Aov::normal},     {"albedo", Aov::albedo},
                                                  {"depth", Aov::depth},       {"direct", Aov::direct},
                                                  {"indirect", Aov::indirect}, {"glossy", Aov::glossy},
                                                  {"contact", Aov::contact},   {"openness", Aov::openness}};
    command
        .add_option(
            "-o,--output", options.output,
            "the picture: .png or .exr; with --animate the pictures, e.g. frame%04d.png, or a video (.mp4, .webm)")
        ->type_name("FILE")
        ->required();
    command.add_option("--size", options.size, "pixels, each side 1 to 16384")
        ->type_name("WxH")
        ->check(parsedBy(parseSize))
        ->capture_default_str();
    command.add_option("--aov", options.aov, "write this layer instead of the picture")
        ->type_name("irradiance|normal|albedo|depth|direct|indirect|glossy|contact|openness")
        ->transform(oneOf(kAovs));
    std::vector<std::string> debugNames;
    std::string debugHelp = "a picture of what the probes do:";
    for (const DebugView& view : debugViews()) {
        debugNames.push_back(view.name);
        debugHelp += fmt::format(" {} ({})", view.name, view.help);
    }
    command.add_option("--debug", options.debug, debugHelp)
        ->type_name(fmt::format("{}", fmt::join(debugNames, "|")))
        ->check(CLI::IsMember(debugNames));
    command.add_option("--antialias", options.antialias, "primary rays per pixel and axis, 1 to 8 (not for reference)")
        ->type_name("N")
        ->check(inRange(1, 8))
        ->capture_default_str();
    command.add_flag("--filmic", options.filmic,
                     "bright light of a .png rolls off smoothly instead of clipping at white");
    command.add_flag("--diffuse-only", options.diffuseOnly, "all materials as matt surfaces of their base colour");
    static const std::map<std::string, Glossy> kGlossy{
        {"off", Glossy::off}, {"first", Glossy::first}, {"field", Glossy::field}};
    command
        .add_option("--glossy", options.glossy,
                    "reflections: none (off, the default: all but lamps is seen by matt light), traced at half the "
                    "resolution (first), and in them further ones from the probes (field); not for reference, which "
                    "has them all")
        ->type_name("off|first|field")
        ->transform(oneOf(kGlossy));
    static const std::map<std::string, bool> kContact{{"on", true}, {"off", false}};
    command
        .add_option("--contact", options.contact,
                    "light and shadow of surfaces nearby, which are finer than the probes, from what the picture shows "
                    "(default off); with --animate each picture goes on from the one before; --aov contact is the "
                    "light that they send, --aov openness how far they leave a surface free; not for reference, "
                    "which has all light")
        ->type_name("on|off")
        ->transform(oneOf(kContact));
    command.add_option("--stats", options.stats, "write probes, frames, times in ms and memory as JSON")
        ->type_name("FILE");
}

void addAnimationOptions(CLI::App& command, RenderOptions& options) {
    constexpr const char* kGroup = "Animation";
    auto* animate = command
                        .add_option("--animate", options.animate,
                                    "pictures of the moving scene from second A to second B, one every STEP seconds; "
                                    "the probes keep their light from picture to picture, as in an engine")
                        ->type_name("A:B:STEP")
                        ->check(parsedBy(parseFrameTimes))
                        ->group(kGroup);
    animate->excludes(command.get_option("--time-of-scene"));
    animate->excludes(command.get_option("--debug"));
    command
        .add_option("--updates-per-frame", options.updatesPerFrame,
                    fmt::format("real-time updates of the probes from one picture to the next, 1 to 1000 (default {})",
                                kDefaultUpdatesPerFrame))
        ->type_name("N")
        ->check(inRange(1, 1000))
        ->group(kGroup);
    command
        .add_option("--events", options.events,
                    "tell the probes near large changes to follow faster for some updates (default on)")
        ->type_name("on|off")
        ->transform(oneOf(kOnOff))
        ->group(kGroup);
}

void addMethodOptions(CLI::App& command, RenderOptions& options) {
    static const std::map<std::string, Method> kMethods{{"none", Method::none},
                                                        {"leaky", Method::leaky},
                                                        {"ddgi", Method::ddgi},
                                                        {"sdfddgi", Method::sdfddgi},
                                                        {"reference", Method::reference}};
    command
        .add_option("--method", options.method,
                    "indirect light: none, from probes without a visibility test (leaky), from probes with one (ddgi, "
                    "the default), from probes that see the primitives of --sdf, and are seen past them (sdfddgi: ddgi "
                    "with --leak-guard sdf-shadow --relocation on --contact on), or all light path traced (reference)")
        ->type_name("none|leaky|ddgi|sdfddgi|reference")
        ->transform(oneOf(kMethods));
    addProbeOptions(command, options);
    addSdfOption(command, options.scene);
    static const std::map<std::string, bool> kProbeRays{{"sdf", false}, {"mesh", true}};
    command
        .add_option("--probe-rays", options.scene.probesHitMesh,
                    "what the rays of probes hit where there is --sdf: its primitives (default), or the scene's "
                    "triangles, so that only --leak-guard sdf-shadow asks the primitives")
        ->type_name("sdf|mesh")
        ->transform(oneOf(kProbeRays));
    addMaskOptions(command, options.masks, {.sdfShadow = true, .moves = true});
    addFieldRunOptions(command, options.run);
    command
        .add_option(
            "--budget", options.budget,
            "limit each real-time update of --frames and --animate to so many rays, or milliseconds: the probes "
            "that need it most come first, by the changes they see, their noise, and the camera, and all in turn "
            "(default: all probes in every update)")
        ->type_name("RAYS|MSms")
        ->check(parsedBy(parseBudget));
    command.add_option("--spp", options.samplesPerPixel, "reference: samples per pixel (default 64 without --time)")
        ->type_name("N")
        ->check(inRange(1, 1e6));
    command.add_option("--time", options.seconds, "reference: stop after this many seconds")
        ->type_name("SECONDS")
        ->check(inRange(0.001, 1e6));
    command
        .add_option("--guide", options.guide,
                    "reference: guide paths by a converged field; changes only the picture's noise (default off: "
                    "filling the field takes time too)")
        ->type_name("on|off")
        ->transform(oneOf(kOnOff));
    command.add_option("--seed", options.seed, "random seed; equal seeds give equal pictures")
        ->type_name("N")
        ->check(wholeNumber())
        ->capture_default_str();
}

}  // namespace

void addRenderCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand("render", "render a picture of a scene");
    const auto options = std::make_shared<RenderOptions>();
    addPictureOptions(*command, *options);
    addMethodOptions(*command, *options);
    addBackendOptions(*command, options->backend);
    addSceneOptions(*command, options->scene);
    addFieldOption(*command, *options);
    addAnimationOptions(*command, *options);
    command->footer(kFooter);
    command->callback([options, command, &exitCode] {
        applyPreset(*command, *options);
        checkOptions(*command, *options);
        if (const auto done = render(*options); !done) exitCode = printError(done.error());
    });
}

}  // namespace probegi::tool
