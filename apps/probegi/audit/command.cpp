#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "audit/picture.h"
#include "audit/text.h"
#include "backend.h"
#include "commands.h"
#include "console/output.h"
#include "console/parse.h"
#include "field_run.h"
#include "probegi/measure.h"
#include "probegi/render.h"
#include "render_options.h"
#include "scene_setup.h"

namespace probegi::tool {

namespace {

constexpr std::size_t kShownPlaces = 10;
constexpr double kLeastHarm = 0.05;  // of the most harmful place's, from which others are shown

struct AuditOptions {
    SceneOptions scene;
    BackendOptions backend;
    FieldRunOptions run;
    Method method = Method::ddgi;
    FieldRules rules = FieldRules::measured;
    MaskOptions masks;
    int rays = FieldDesc{}.raysPerProbe;
    std::uint64_t seed = 1;
    int points = AuditDesc{}.points;
    double leastPercent = 100 * AuditDesc{}.least;
    std::optional<double> maxLeakPercent;
    int truthSamples = AuditDesc{}.truthSamples;
    std::string json, picture, size = "960x540";
};

const char* const kFooter =
    R"(Looks at points all over the scene's surfaces. Where probes that geometry hides from a point have weight in its
answer, and are lit otherwise than those that it sees, light or shadow leaks. Leaking points side by side are a place;
each is told with its position (the scene's own coordinates), size, cause and what would help, the most visible first.
A path tracer confirms each: where the light is right in spite of the weights, the place is passed over.
A leak in percent is light that comes through, over the light of the brighter side.

With --max-leak the exit status is 1 if a place leaks more than that on average, so that a level's CI can fail.

Example: probegi audit builtin:dark-room --wall 0.02
Example: probegi audit level.glb --sun 0.2,-0.9,0.3,20 --max-leak 2 --json leaks.json
Example: probegi audit builtin:house --picture leaks.png --camera 1
Example: probegi audit builtin:dark-room --method leaky      (the same probes without their leak guard)
Example: probegi audit builtin:house --leak-guard masks)";

Result<Field> makeField(const Backend& backend, const LoadedSetup& setup, const AuditOptions& options) {
    FieldDesc desc;
    desc.volumes = setup.volumes;
    desc.raysPerProbe = options.rays;
    desc.rules = options.rules;
    desc.seed = options.seed;
    return backend.makeField(desc, fieldSettings(setup, options.method, options.rules));
}

AuditDesc auditDesc(const AuditOptions& options) {
    AuditDesc desc;
    desc.points = options.points;
    desc.least = options.leastPercent / 100;
    // A bound below what is passed over could not be broken.
    if (options.maxLeakPercent) desc.least = std::clamp(*options.maxLeakPercent / 100, 1e-4, desc.least);
    desc.seed = options.seed;
    desc.truthSamples = std::max(options.truthSamples, 1);
    return desc;
}

void print(const LeakAudit& audit, const AuditDesc& desc, glm::vec3 origin) {
    std::size_t shown = std::min(audit.places.size(), kShownPlaces);
    while (shown > 1 && audit.places[shown - 1].harm < kLeastHarm * audit.places.front().harm) --shown;
    for (std::size_t i = 0; i < shown; ++i) {
        const PlaceText text = describe(audit.places[i], origin);
        fmt::print("{:2}. {}\n    {}\n    why: {}\n    what helps: {}\n", i + 1, text.title, text.where, text.why,
                   text.remedy);
    }
    if (audit.places.size() > shown)
        fmt::print("    and {} less visible (--json lists all)\n", audit.places.size() - shown);
    fmt::print("{}{}\n", audit.places.empty() ? "" : "\n", auditSummary(audit, desc));
    if (audit.harmless > 0)
        fmt::print("{} {} passed over, since the path tracer finds the light there right\n", audit.harmless,
                   audit.harmless == 1 ? "more was" : "more were");
}

/// Errors: invalidArgument if a place leaks more than the bound.
Result<void> judge(const LeakAudit& audit, const AuditOptions& options) {
    if (options.maxLeakPercent && audit.points == 0)
        return fail(ErrorCode::invalidArgument,
                    "no surface lies in the open, so --max-leak has nothing to judge; check the winding of the meshes");
    if (!options.maxLeakPercent || 100 * audit.worst <= *options.maxLeakPercent) return {};
    const auto over = std::count_if(audit.places.begin(), audit.places.end(), [&](const LeakPlace& p) {
        return 100 * std::abs(p.leak) > *options.maxLeakPercent;
    });
    return fail(ErrorCode::invalidArgument,
                fmt::format("the field leaks: {} {} more than the {:.4g} % of --max-leak, the worst {:.3g} %", over,
                            over == 1 ? "place leaks" : "places leak", *options.maxLeakPercent, 100 * audit.worst));
}

Result<void> writePicture(const Context& context, const Tracer& rays, const Field& field, const LoadedSetup& setup,
                          const AuditOptions& options, const AuditDesc& desc) {
    const PictureSize size = *parseSize(options.size);
    PictureDesc picture;
    picture.camera = setup.camera;
    picture.width = size.width, picture.height = size.height;
    const auto rendered = renderPicture(context, rays, setup.lighting, &field, picture);
    if (!rendered) return rendered.error();
    const auto seen = leaksSeen(context, rays, field, setup.camera, size.width, size.height);
    if (!seen) return seen.error();
    const HdrImage& color = rendered->picture.color;
    return writeImage(options.picture, drawLeaks(color, shownExposure(setup, color), *seen, desc));
}

Result<void> audit(const AuditOptions& options) {
    Outputs outputs;
    if (!options.json.empty())
        if (auto claimed = outputs.claim("--json", options.json); !claimed) return claimed;
    if (!options.picture.empty())
        if (auto claimed = outputs.claim("--picture", options.picture, pictureExtensions()); !claimed) return claimed;
    const auto context = makeContext(options.scene.threads);
    if (!context) return context.error();
    const auto backend = openBackend(*context, options.backend);
    if (!backend) return backend.error();
    const auto setup = loadSetup(options.scene);
    if (!setup) return setup.error();
    if (auto apart = outputs.keepApartFrom(setup->files); !apart) return apart;
    const auto tracer = (*backend)->openScene(*setup->scene, setup->pose);
    if (!tracer) return tracer.error();
    auto field = makeField(**backend, *setup, options);
    if (!field) return field.error();
    if (options.masks.bakes())
        if (auto baked = bakeMasksFor(*field, *context, **tracer, *setup, options.masks); !baked) return baked;
    if (const auto run = runField(*field, **tracer, setup->lighting, options.run); !run) return run.error();

    // The audit's own rays are traced on the CPU whatever the backend.
    const auto rays = makeEmbreeTracer(*context, *setup->scene, setup->pose);
    if (!rays) return rays.error();
    AuditDesc desc = auditDesc(options);
    const auto pathTracer = PathTracer::create(*context, *setup->scene, setup->pose, **rays, setup->lighting);
    if (!pathTracer) return pathTracer.error();
    if (options.truthSamples > 0) desc.truth = &*pathTracer;
    const auto found = auditLeaks(*context, *setup->scene, setup->pose, **rays, *field, desc);
    if (!found) return found.error();

    if (!options.json.empty()) {
        nlohmann::ordered_json json = auditJson(*found, desc, setup->scene->origin);
        json["scene"] = options.scene.scene;
        json["probes"] = probeCount(*setup);
        json["maxLeak"] = options.maxLeakPercent ? nlohmann::ordered_json(*options.maxLeakPercent / 100) : nullptr;
        json["passed"] = judge(*found, options).has_value();
        if (auto written = writeText(options.json, jsonText(json)); !written) return written;
    }
    if (!options.picture.empty())
        if (auto written = writePicture(*context, **rays, *field, *setup, options, desc); !written) return written;
    std::error_code none;
    if (!std::filesystem::equivalent(options.json, "/dev/stdout", none)) print(*found, desc, setup->scene->origin);
    return judge(*found, options);
}

void addAuditOptions(CLI::App& command, AuditOptions& options) {
    command
        .add_option("--max-leak", options.maxLeakPercent,
                    "fail (exit status 1) if a place leaks more than this on average, 0.01 to 100")
        ->type_name("PERCENT")
        ->check(inRange(0.01, 100));
    command.add_option("--least", options.leastPercent, "pass over points that leak less, 0.01 to 100")
        ->type_name("PERCENT")
        ->check(inRange(0.01, 100))
        ->capture_default_str();
    command.add_option("--json", options.json, "write all that was found as JSON")->type_name("FILE");
    command
        .add_option("--picture", options.picture,
                    "write what the camera sees, leaking light red, leaking shadow blue: .png or .exr")
        ->type_name("FILE");
    command.add_option("--size", options.size, "of the picture, each side 1 to 16384 pixels")
        ->type_name("WxH")
        ->check(parsedBy(parseSize))
        ->capture_default_str();
    command.add_option("--points", options.points, "points of surfaces to look at, 1 to 4194304")
        ->type_name("N")
        ->check(inRange(1, 1 << 22))
        ->capture_default_str();
    command
        .add_option("--truth-samples", options.truthSamples,
                    "paths a point by which places are confirmed, 0 to 65536; 0: the weights alone decide")
        ->type_name("N")
        ->check(inRange(0, 65536))
        ->capture_default_str();
}

void addFieldOptions(CLI::App& command, AuditOptions& options) {
    static const std::map<std::string, Method> kMethods{{"leaky", Method::leaky}, {"ddgi", Method::ddgi}};
    command
        .add_option("--method", options.method,
                    "probes without a visibility test (leaky), or with one (ddgi, the default)")
        ->type_name("leaky|ddgi")
        ->transform(oneOf(kMethods));
    static const std::map<std::string, FieldRules> kRules{{"measured", FieldRules::measured},
                                                          {"paper", FieldRules::paper}};
    command.add_option("--rules", options.rules, "the field's rules, as in 'probegi render'")
        ->type_name("measured|paper")
        ->transform(oneOf(kRules));
    command.add_option("--rays", options.rays, "rays per probe and update, 8 to 4096")
        ->type_name("N")
        ->check(inRange(8, 4096))
        ->capture_default_str();
    addMaskOptions(command, options.masks);
    addFieldRunOptions(command, options.run);
    command.add_option("--seed", options.seed, "random seed of the field and the points")
        ->type_name("N")
        ->check(wholeNumber())
        ->capture_default_str();
}

}  // namespace

void addAuditCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand("audit", "find where light leaks through geometry, why, and what helps");
    const auto options = std::make_shared<AuditOptions>();
    addSceneOptions(*command, options->scene);
    addAuditOptions(*command, *options);
    addFieldOptions(*command, *options);
    addBackendOptions(*command, options->backend);
    command->footer(kFooter);
    command->callback([options, command, &exitCode] {
        checkBackendOptions(*command, options->backend);
        checkMaskOptions(options->masks, options->scene.volumes);
        if (options->masks.bakes() && options->method != Method::ddgi)
            throw CLI::ValidationError("--leak-guard", "masks are looked up with --method ddgi only");
        if (const auto done = audit(*options); !done) exitCode = printError(done.error());
    });
}

}  // namespace probegi::tool
