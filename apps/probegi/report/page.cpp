#include "report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "audit/text.h"
#include "probegi/measure.h"
#include "report/linear_png.h"
#include "report/probe_picture.h"
#include "report/tables.h"

namespace probegi::tool {

namespace {

Result<std::string> readBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (!file.good() && !file.eof())
        return fail(ErrorCode::fileUnreadable, fmt::format("'{}' cannot be read back", path.string()));
    return bytes;
}

// For pictures of other things than light: no exposure, and no dither, which makes files large.
constexpr ToneMap kPlain{.exposure = 1, .filmic = false, .dither = false};

/// The bytes of a picture as a PNG. With `keep`, the file stays in the folder.
Result<std::string> pngBytes(const ReportPlace& place, const std::string& name, const HdrImage& image,
                             const ToneMap& display, bool keep) {
    const auto path = place.folder / fmt::format("{}-{}.png", place.prefix, name);
    if (auto written = writeImage(path, image, display); !written) return written.error();
    auto bytes = readBytes(path);
    std::error_code ignored;
    if (!keep) std::filesystem::remove(path, ignored);
    return bytes;
}

/// A picture to look at, and the values behind it.
struct Shown {
    ReportPicture text;  ///< without the PNGs; no values are stored if it has no unit
    const HdrImage& image;
    ToneMap display;
    const HdrImage& values;
};

Result<ReportPicture> keepPicture(const ReportPlace& place, const std::string& view, const Shown& shown) {
    ReportPicture picture = shown.text;
    auto png = pngBytes(place, view + picture.id, shown.image, shown.display, true);
    if (!png) return png.error();
    picture.png = std::move(*png);
    if (picture.unit.empty()) return picture;
    auto values = pngBytes(place, view + picture.id + "-values", halfFloatPlanes(shown.values), kPlain, false);
    if (!values) return values.error();
    picture.values = std::move(*values);
    return picture;
}

struct Lit {
    const char* id;
    const char* title;
    const char* caption;
    const Picture& picture;
    const MethodResult* method;  ///< null: the reference
};

std::vector<Lit> lightings(const RenderedView& view) {
    return {{"none", "No GI", "Direct light only: what no lamp reaches is black.", view.none.picture, &view.none},
            {"leaky", "Leaking field", "Probes without a visibility test: their light passes through walls.",
             view.leaky.picture, &view.leaky},
            {"ddgi", "Field", "Probes with a visibility test: they light only what they see.", view.ddgi.picture,
             &view.ddgi},
            {"reference", "Reference", "Path traced, without any approximation: the truth, with some noise.",
             view.reference, nullptr}};
}

/// Follows the scene's prefix in the file names of a view.
std::string viewPrefix(std::size_t number) {
    return number == 0 ? std::string() : fmt::format("camera{}-", number);
}

constexpr const char* kRadiance = "W/sr/m\u00b2";

Result<ReportPicture> lightPicture(const ReportPlace& place, const std::string& prefix, const Lit& light,
                                   const ToneMap& display) {
    ReportPicture text{.id = light.id,
                       .title = light.title,
                       .caption = light.caption,
                       .alt = fmt::format("{}: {}", place.title, light.title),
                       .unit = kRadiance,
                       .light = true,
                       .exr = fmt::format("{}-{}{}.exr", place.prefix, prefix, light.id)};
    if (auto written = writeImage(place.folder / text.exr, light.picture.color); !written) return written.error();
    return keepPicture(place, prefix, {std::move(text), light.picture.color, display, light.picture.color});
}

Result<ReportPicture> flipPicture(const ReportPlace& place, const std::string& prefix, const std::string& id,
                                  const std::string& title, const std::string& caption, const HdrImage& map) {
    const ReportPicture text{
        .id = fmt::format("flip-{}", id),
        .title = title,
        .caption = caption,
        .alt = fmt::format("{}: map of visible differences from the reference, {}", place.title, title),
    };
    return keepPicture(place, prefix, {text, linearFromDisplay(heatmap(map)), kPlain, map});
}

Result<ReportPicture> leakPicture(const ReportPlace& place, const std::string& prefix, const LeakMap& leaks) {
    const ReportPicture text{
        .id = "leaks",
        .title = "Leak map",
        .caption = fmt::format("The field's indirect light over the reference's, where noise cannot explain the "
                               "difference: reddish is too much, bluish too little, full red visibly {} times or more. "
                               "{} of {} places leak. Light that came through a wall and a contact shadow finer than "
                               "the probes' spacing look the same here: the reference beside it tells which it is.",
                               kLeakRatio, leaks.leaks, leaks.tiles),
        .alt = fmt::format("{}: map of places where the field leaks", place.title),
        .unit = "times the reference's indirect light"};
    return keepPicture(place, prefix, {text, leaks.picture, kPlain, leaks.ratio});
}

Result<ReportPicture> hiddenPicture(const ReportPlace& place, const std::string& prefix, const HdrImage& picture) {
    const ReportPicture text{
        .id = "hidden",
        .title = "Leaks through geometry",
        .caption =
            "Light that probes behind geometry bring (red) or take (blue), by exact visibility, without the "
            "reference. The table of places below says why, and what helps.",
        .alt = fmt::format("{}: map of light from probes behind geometry", place.title)};
    return keepPicture(place, prefix, {text, picture, kPlain, picture});
}

Result<std::vector<ReportPicture>> mapsOf(const RenderedView& view, const ReportPlace& place,
                                          const std::string& prefix) {
    std::vector<Result<ReportPicture>> made{leakPicture(place, prefix, view.leaks),
                                            hiddenPicture(place, prefix, view.hiddenLeaks)};
    for (const Lit& light : lightings(view))
        if (light.method)
            made.push_back(flipPicture(place, prefix, light.id, fmt::format("Error: {}", light.title),
                                       fmt::format("Mean FLIP {:.4f}; an exact picture would score {:.4f} for the "
                                                   "reference's noise.",
                                                   light.method->whole.difference.flip, view.noiseFloor.flip),
                                       light.method->whole.flipMap));
    made.push_back(flipPicture(place, prefix, "exact", "Noise floor",
                               fmt::format("What an exact picture would score, {:.4f}: the reference's own noise. "
                                           "Smaller differences cannot be measured.",
                                           view.noiseFloor.flip),
                               view.noiseMap));
    std::vector<ReportPicture> maps;
    for (Result<ReportPicture>& map : made) {
        if (!map) return map.error();
        maps.push_back(std::move(*map));
    }
    return maps;
}

std::string cameraName(const RenderedView& view, std::size_t number) {
    return view.camera.name.empty() ? std::to_string(number) : view.camera.name;
}

Result<ReportView> describeView(const RenderedView& view, const ReportPlace& place, std::size_t number,
                                std::size_t views, bool filmic) {
    ReportView described;
    if (views > 1) described.title = "Camera " + cameraName(view, number);
    described.exposure = view.exposure;
    described.filmic = filmic;
    const std::string prefix = viewPrefix(number);
    for (const Lit& light : lightings(view)) {
        auto picture = lightPicture(place, prefix, light, {view.exposure, filmic});
        if (!picture) return picture.error();
        described.pictures.push_back(std::move(*picture));
    }
    auto maps = mapsOf(view, place, prefix);
    if (!maps) return maps.error();
    described.maps = std::move(*maps);
    return described;
}

ViewFacts factsOf(const RenderedView& view, std::size_t number, std::size_t views) {
    return {views > 1 ? cameraName(view, number) : std::string(),
            view.ddgi.whole.difference,
            view.noiseFloor,
            view.referenceSeconds,
            view.leaks.leaks,
            view.leaks.tiles,
            view.leaks.worst};
}

/// Every view of a scene, the first camera's first.
std::vector<const RenderedView*> viewsOf(const RenderedScene& scene) {
    std::vector<const RenderedView*> views{&scene};
    for (const RenderedView& view : scene.others) views.push_back(&view);
    return views;
}

Result<void> describeProbes(const RenderedScene& scene, const ReportPlace& place, ReportScene& section) {
    const std::vector<ProbeState> states = probeStates(scene.probes);
    for (std::size_t i = 0; i < kProbeStates; ++i) {
        const auto state = ProbeState(i);
        const auto count = std::count(states.begin(), states.end(), state);
        section.probeKey.push_back({colourOf(state), fmt::format("{} {}", grouped(std::size_t(count)), nameOf(state))});
    }
    ReportPicture picture{.id = "probes",
                          .title = "Probes",
                          .caption = "Every probe that the camera sees; those in walls shine through.",
                          .alt = fmt::format("{}: the probes, coloured by their state", place.title)};
    auto png = pngBytes(place, "probes",
                        drawProbes(scene.ddgi.picture, scene.exposure, scene.camera, scene.grid, states), kPlain, true);
    if (!png) return png.error();
    picture.png = std::move(*png);
    section.probes.push_back(std::move(picture));
    return {};
}

nlohmann::json numbers(const ImageDifference& d) {
    return {{"rmse", d.rmse},
            {"relmse", d.relmse},
            {"scaledRelmse", d.scaledRelmse},
            {"flip", d.flip},
            {"ratio",
             {{"mean", d.ratio.mean},
              {"p5", d.ratio.low},
              {"median", d.ratio.median},
              {"p95", d.ratio.high},
              {"blocks", d.ratio.blocks}}}};
}

nlohmann::json numbers(const FieldResult& f) {
    return {
        {"updates", f.run.updates.size()},
        {"converged", f.run.convergence ? nlohmann::json(f.run.convergence->converged) : nlohmann::json()},
        {"seconds", f.seconds},
        {"updateMs",
         {{"trace", f.update.trace}, {"shade", f.update.shade}, {"blend", f.update.blend}, {"total", f.update.total}}},
        {"bytes", f.memory.persistentBytes()},
        {"ratio", {{"p5", f.ratio.low}, {"median", f.ratio.median}, {"p95", f.ratio.high}}}};
}

}  // namespace

Verdict verdictOf(const RenderedScene& scene) {
    const std::vector<const RenderedView*> views = viewsOf(scene);
    std::vector<ViewFacts> facts;
    for (std::size_t i = 0; i < views.size(); ++i) facts.push_back(factsOf(*views[i], i, views.size()));
    return judge(facts);
}

Result<ReportScene> describeScene(const RenderedScene& scene, const ReportPlace& place, bool filmic) {
    ReportScene section;
    section.title = place.title;
    section.summary = reportSummary(scene);
    section.figures = reportFigures(scene);
    section.tables = reportTables(scene);
    const Verdict verdict = verdictOf(scene);
    section.verdict = verdict.sentence;
    section.judgement = nameOf(verdict.judgement);
    const std::vector<const RenderedView*> views = viewsOf(scene);
    for (std::size_t i = 0; i < views.size(); ++i) {
        auto view = describeView(*views[i], place, i, views.size(), filmic);
        if (!view) return view.error();
        section.views.push_back(std::move(*view));
    }
    if (auto done = describeProbes(scene, place, section); !done) return done.error();
    return section;
}

nlohmann::json sceneNumbers(const RenderedScene& scene) {
    nlohmann::json json;
    json["triangles"] = scene.triangles;
    json["probes"] = probeCount(scene.grid);
    for (const auto& [name, method] :
         {std::pair("none", &scene.none), std::pair("leaky", &scene.leaky), std::pair("ddgi", &scene.ddgi)})
        json["methods"][name] = {{"picture", numbers(method->whole.difference)},
                                 {"indirect", numbers(method->indirectOnly)},
                                 {"pictureMs", method->pictureMs}};
    json["methods"]["leaky"]["field"] = numbers(scene.leakyField);
    json["methods"]["ddgi"]["field"] = numbers(scene.ddgiField);
    json["reference"] = {{"samplesPerPixel", scene.referenceSamples},
                         {"seconds", scene.referenceSeconds},
                         {"relativeNoise", scene.referenceNoise},
                         {"noiseFloor", numbers(scene.noiseFloor)},
                         {"indirectNoiseFloor", numbers(scene.indirectNoiseFloor)}};
    const Verdict verdict = verdictOf(scene);
    json["verdict"] = {{"judgement", nameOf(verdict.judgement)}, {"sentence", verdict.sentence}};
    json["views"] = nlohmann::json::array();
    for (const RenderedView* view : viewsOf(scene)) {
        const LeakMap& leaks = view->leaks;
        json["views"].push_back({{"camera", view->camera.name},
                                 {"exposure", view->exposure},
                                 {"picture", numbers(view->ddgi.whole.difference)},
                                 {"noiseFloor", numbers(view->noiseFloor)},
                                 {"leaks", {{"places", leaks.leaks}, {"of", leaks.tiles}, {"worst", leaks.worst}}}});
    }
    json["audit"] = nlohmann::json(auditJson(scene.audit, scene.auditDesc, scene.origin));
    json["ratioProbes"] = {{"used", scene.truth.probes.size()},
                           {"inWalls", scene.truth.inWalls},
                           {"dark", scene.truth.dark},
                           {"relativeNoise", scene.truth.noise}};
    return json;
}

std::vector<std::string> legendColours() {
    constexpr int kSteps = 17;
    HdrImage ramp(kSteps, 1);
    for (int i = 0; i < kSteps; ++i) ramp.at(i, 0) = glm::vec3(float(i) / (kSteps - 1));
    std::vector<std::string> colours;
    const auto byte = [](float v) { return int(std::lround(255 * v)); };
    for (const glm::vec3& c : heatmap(ramp).pixels)
        colours.push_back(fmt::format("#{:02x}{:02x}{:02x}", byte(c.x), byte(c.y), byte(c.z)));
    return colours;
}

}  // namespace probegi::tool
