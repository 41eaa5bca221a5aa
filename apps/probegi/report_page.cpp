#include "report_page.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "report_tables.h"

namespace probegi::tool {

namespace {

Result<std::string> readBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (!file.good() && !file.eof())
        return fail(ErrorCode::fileUnreadable, fmt::format("'{}' cannot be read back", path.string()));
    return bytes;
}

/// Writes one PNG and keeps its bytes.
Result<ReportPicture> keepPicture(const ReportPlace& place, ReportPicture picture, const HdrImage& image,
                                  const ToneMap& display) {
    const auto path = place.folder / fmt::format("{}-{}.png", place.prefix, picture.id);
    if (auto written = writeImage(path, image, display); !written) return written.error();
    auto bytes = readBytes(path);
    if (!bytes) return bytes.error();
    picture.png = std::move(*bytes);
    return picture;
}

struct Shown {
    const char* id;
    const char* title;
    const char* caption;
    const Picture& picture;
    const MethodResult* method;  ///< null: the reference
};

std::vector<Shown> shownPictures(const RenderedScene& scene) {
    return {{"none", "No GI", "Direct light only: what no lamp reaches is black.", scene.none.picture, &scene.none},
            {"leaky", "Leaking field", "Probes without a visibility test: their light passes through walls.",
             scene.leaky.picture, &scene.leaky},
            {"ddgi", "Field", "Probes that know how far they see, and light only what they see.", scene.ddgi.picture,
             &scene.ddgi},
            {"reference", "Reference", "Path traced, without any approximation: the truth, with some noise.",
             scene.reference, nullptr}};
}

Result<ReportPicture> errorMap(const Shown& shown, const ReportPlace& place, double exactFlip) {
    const ReportPicture picture{
        fmt::format("flip-{}", shown.id),
        fmt::format("Error: {}", shown.title),
        fmt::format("Mean FLIP {:.4f}; an exact picture would score {:.4f} for the reference's noise.",
                    shown.method->whole.difference.flip, exactFlip),
        fmt::format("{}: map of visible differences between {} and the reference", place.title, shown.title),
        {}};
    return keepPicture(place, picture, linearFromDisplay(heatmap(shown.method->whole.flipMap)), {});
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

Result<ReportScene> describeScene(const RenderedScene& scene, const ReportPlace& place, const ToneMap& display) {
    ReportScene section;
    section.title = place.title;
    section.summary = reportSummary(scene);
    section.figures = reportFigures(scene);
    section.tables = reportTables(scene);
    for (const Shown& shown : shownPictures(scene)) {
        const auto exr = place.folder / fmt::format("{}-{}.exr", place.prefix, shown.id);
        if (auto written = writeImage(exr, shown.picture.color); !written) return written.error();
        const ReportPicture plain{
            shown.id, shown.title, shown.caption, fmt::format("{}: {}", place.title, shown.title), {}};
        auto picture = keepPicture(place, plain, shown.picture.color, display);
        if (!picture) return picture.error();
        section.pictures.push_back(std::move(*picture));
        if (!shown.method) continue;
        auto map = errorMap(shown, place, scene.noiseFloor.flip);
        if (!map) return map.error();
        section.errorMaps.push_back(std::move(*map));
    }
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
