#include "report/tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "audit/text.h"
#include "console/machine.h"
#include "console/output.h"

namespace probegi::tool {

namespace {

std::string milliseconds(double ms) {
    if (ms >= 1000) return fmt::format("{:.2f} s", ms / 1000);
    return ms >= 100 ? fmt::format("{:.0f} ms", ms) : fmt::format("{:.2g} ms", ms);
}

std::string megabytes(std::size_t bytes) {
    return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

std::string percent(double share) {
    return fmt::format("{:.1f} %", 100 * share);
}

std::vector<std::string> differenceRow(const char* name, const ImageDifference& d) {
    return {name, fmt::format("{:.4f}", d.rmse), fmt::format("{:.4f}", d.relmse), fmt::format("{:.4f}", d.scaledRelmse),
            fmt::format("{:.4f}", d.flip)};
}

const std::vector<std::string> kDifferenceHeader{"", "RMSE", "relMSE", "scaled", "FLIP"};

ReportTable wholeTable(const RenderedScene& scene) {
    return {"Error of the whole picture",
            kDifferenceHeader,
            {differenceRow("No GI", scene.none.whole.difference),
             differenceRow("Leaking field", scene.leaky.whole.difference),
             differenceRow("Field", scene.ddgi.whole.difference), differenceRow("An exact picture", scene.noiseFloor)},
            fmt::format("The reference has noise, so even an exact picture would not score 0: its standard error is "
                        "{} of its mean at {} samples a pixel. Scaled: relMSE relative to the reference's own "
                        "brightness where it is dark.",
                        percent(scene.referenceNoise), grouped(std::size_t(scene.referenceSamples)))};
}

ReportTable indirectTable(const RenderedScene& scene) {
    return {
        "Error of the indirect light alone",
        kDifferenceHeader,
        {differenceRow("No GI", scene.none.indirectOnly), differenceRow("Leaking field", scene.leaky.indirectOnly),
         differenceRow("Field", scene.ddgi.indirectOnly), differenceRow("An exact picture", scene.indirectNoiseFloor)},
        ""};
}

ReportTable cameraTable(const RenderedScene& scene) {
    ReportTable table{"The field, camera by camera",
                      {"", "FLIP", "exact picture", "light, mean", "5th", "95th"},
                      {},
                      "Light of the picture over the reference's; an exact picture's FLIP is the reference's noise."};
    std::size_t number = 0;
    const auto add = [&](const RenderedView& view) {
        const ImageDifference& d = view.ddgi.whole.difference;
        const std::string name = view.camera.name.empty() ? std::to_string(number) : view.camera.name;
        table.rows.push_back({name, fmt::format("{:.4f}", d.flip), fmt::format("{:.4f}", view.noiseFloor.flip),
                              fmt::format("{:.3f}", d.ratio.mean), fmt::format("{:.3f}", d.ratio.low),
                              fmt::format("{:.3f}", d.ratio.high)});
        ++number;
    };
    add(scene);
    for (const RenderedView& view : scene.others) add(view);
    return table;
}

std::vector<std::string> lightRow(const char* name, const LightRatio& r) {
    return {name, fmt::format("{:.3f}", r.mean), fmt::format("{:.3f}", r.low), fmt::format("{:.3f}", r.median),
            fmt::format("{:.3f}", r.high)};
}

ReportTable lightTable(const RenderedScene& scene) {
    return {"Light of the picture, over the reference's",
            {"", "mean", "5th", "50th", "95th"},
            {lightRow("No GI", scene.none.whole.difference.ratio),
             lightRow("Leaking field", scene.leaky.whole.difference.ratio),
             lightRow("Field", scene.ddgi.whole.difference.ratio),
             lightRow("Field, indirect light", scene.ddgi.indirectOnly.ratio),
             lightRow("An exact picture", scene.noiseFloor.ratio)},
            fmt::format("1 is right. Percentiles over {} of 40 blocks of the picture; the others are black in the "
                        "reference.",
                        scene.ddgi.whole.difference.ratio.blocks)};
}

ReportTable ratioTable(const RenderedScene& scene) {
    const auto row = [](const char* name, const Percentiles& p) {
        return std::vector<std::string>{name, fmt::format("{:.3f}", p.low), fmt::format("{:.3f}", p.median),
                                        fmt::format("{:.3f}", p.high)};
    };
    const ProbeTruth& truth = scene.truth;
    return {
        "Irradiance at the probes, over the reference",
        {"", "5th percentile", "median", "95th percentile"},
        {row("Leaking field", scene.leakyField.ratio), row("Field", scene.ddgiField.ratio)},
        fmt::format(
            "1 is right. Filled by {}. {} probes spread over the grid; left out: {} inside walls (over a quarter of "
            "their rays hit the back of a wall) and {} with too little light for a ratio. Noise of the "
            "reference at a probe: {}.",
            scene.ddgiField.description, truth.probes.size(), truth.inWalls, truth.dark, percent(truth.noise))};
}

ReportTable timeTable(const RenderedScene& scene) {
    const FieldResult& field = scene.ddgiField;
    return {"Time",
            {},
            {{"One update: rays", milliseconds(field.update.trace)},
             {"One update: light at their hits", milliseconds(field.update.shade)},
             {"One update: blend into the probes", milliseconds(field.update.blend)},
             {"One update: total", milliseconds(field.update.total)},
             {"Updates until this picture", fmt::format("{}, in {:.1f} s", field.description, field.seconds)},
             {"Picture without GI", milliseconds(scene.none.pictureMs)},
             {"Picture with the field", milliseconds(scene.ddgi.pictureMs)},
             {"Reference", fmt::format("{:.1f} s", scene.referenceSeconds)},
             {"Ray tracer set up", fmt::format("{:.2f} s", scene.prepareSeconds)}},
            fmt::format("Medians, on {}.", processorName())};
}

ReportTable sceneTable(const RenderedScene& scene) {
    const VolumeDesc& grid = scene.grid;
    const FieldMemory& memory = scene.ddgiField.memory;
    const auto probes = std::size_t(probeCount(grid));
    return {"Scene and memory",
            {},
            {{"Triangles", grouped(scene.triangles)},
             {"Lights besides sky and glowing surfaces", grouped(scene.lights)},
             {"Probes", fmt::format("{} x {} x {} = {}", grid.counts.x, grid.counts.y, grid.counts.z, grouped(probes))},
             {"Metres between probes",
              fmt::format("{:.3g} x {:.3g} x {:.3g}", grid.spacing.x, grid.spacing.y, grid.spacing.z)},
             {"Memory of the probes", fmt::format("{}, {:.0f} bytes each", megabytes(memory.persistentBytes()),
                                                  double(memory.persistentBytes()) / double(probes))},
             {"Scratch memory of updates", megabytes(memory.scratchBytes)},
             {"Largest memory of the whole run so far", megabytes(peakMemoryBytes())}},
            ""};
}

}  // namespace

std::string grouped(std::size_t number) {
    const std::string digits = std::to_string(number);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
        text += digits[i];
    }
    return text;
}

namespace {

constexpr std::size_t kPlaces = 10;  // of an audit that are listed

ReportTable auditTable(const RenderedScene& scene) {
    ReportTable table{"Where the field leaks through geometry", {"", "where", "why", "what helps"}, {}, ""};
    for (std::size_t i = 0; i < std::min(scene.audit.places.size(), kPlaces); ++i) {
        const PlaceText text = describe(scene.audit.places[i], scene.origin);
        table.rows.push_back({text.title, text.where, text.why, text.remedy});
    }
    if (table.rows.empty()) table.header.clear();
    table.note = auditSummary(scene.audit, scene.auditDesc) +
                 ". The most visible first; probegi audit lists them all, and can fail a level's tests.";
    return table;
}

}  // namespace

std::vector<ReportTable> reportTables(const RenderedScene& scene) {
    std::vector<ReportTable> tables{wholeTable(scene), indirectTable(scene), lightTable(scene), ratioTable(scene),
                                    timeTable(scene),  sceneTable(scene),    auditTable(scene)};
    if (!scene.others.empty()) tables.insert(tables.begin(), cameraTable(scene));
    return tables;
}

std::vector<ReportFigure> reportFigures(const RenderedScene& scene) {
    return {{fmt::format("{:.3f}", scene.ddgiField.ratio.median),
             fmt::format("light at the probes over the reference, median of {} probes after {}",
                         scene.truth.probes.size(), scene.ddgiField.description)},
            {fmt::format("{:.3f}", scene.ddgi.whole.difference.ratio.mean),
             "light of the picture over the reference's, mean"},
            {fmt::format("{:.3f}", scene.ddgi.whole.difference.flip),
             fmt::format("visible error of the field (FLIP); without GI {:.3f}, an exact picture {:.3f} for the "
                         "reference's noise",
                         scene.none.whole.difference.flip, scene.noiseFloor.flip)},
            {milliseconds(scene.ddgiField.update.total), "one update of all probes"},
            {milliseconds(scene.ddgi.pictureMs), "picture with the field"},
            {fmt::format("{:.1f} s", scene.referenceSeconds),
             fmt::format("reference, {} samples a pixel", grouped(std::size_t(scene.referenceSamples)))}};
}

std::string reportSummary(const RenderedScene& scene) {
    return fmt::format("{} triangles lit through {} probes; pictures of {} x {} pixels.", grouped(scene.triangles),
                       grouped(std::size_t(probeCount(scene.grid))), scene.reference.color.width,
                       scene.reference.color.height);
}

}  // namespace probegi::tool
