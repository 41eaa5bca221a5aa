#include "glossy.h"

#include <fmt/format.h>

#include <utility>

#include "probegi/reference.h"

namespace probegi::accuracy {

namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr float kTolerance = 0.02f;  ///< of converge()
constexpr int kMostUpdates = 64;     ///< of converge()

}  // namespace

Result<std::vector<GlossyRow>> measureGlossy(const Context& context, const std::string& name,
                                             const tool::LoadedSetup& setup, int samplesPerPixel) {
    const auto tracer = makeEmbreeTracer(context, *setup.scene, setup.pose);
    if (!tracer) return tracer.error();
    const auto pathTracer = PathTracer::create(context, *setup.scene, setup.pose, **tracer, setup.lighting);
    if (!pathTracer) return pathTracer.error();
    PictureDesc desc{.camera = setup.camera, .width = kWidth, .height = kHeight};
    const auto truth = pathTracer->render({.picture = desc, .samplesPerPixel = samplesPerPixel});
    if (!truth) return truth.error();
    const ToneMap toneMap{.exposure = tool::shownExposure(setup, truth->picture.color)};
    FieldDesc fieldDesc;
    fieldDesc.volumes = setup.volumes;
    auto field = Field::create(context, fieldDesc);
    if (!field) return field.error();
    if (const auto done = field->converge(**tracer, setup.lighting, kTolerance, kMostUpdates); !done)
        return done.error();
    std::vector<GlossyRow> rows;
    for (const auto& [word, glossy] :
         {std::pair("off", Glossy::off), {"first", Glossy::first}, {"field", Glossy::field}}) {
        desc.glossy = glossy;
        const auto drawn = renderPicture(context, **tracer, setup.lighting, &*field, desc);
        if (!drawn) return drawn.error();
        const auto error = compareImages(drawn->picture.color, truth->picture.color, toneMap);
        if (!error) return error.error();
        rows.push_back({name, word, error->difference});
    }
    const auto exact = noiseFloor(truth->picture.color, truth->standardError, 1, toneMap);
    if (!exact) return exact.error();
    rows.push_back({name, "exact", exact->difference});
    return rows;
}

std::string glossyTable(const std::vector<GlossyRow>& rows) {
    if (rows.empty()) return {};
    std::string text =
        "\n### Glossy light, all of the picture against the path tracer\n\n"
        "`exact` is the score of the reference with noise of its own again.\n\n"
        "| scene | glossy | RMSE | mean ratio | FLIP |\n"
        "|---|---|---:|---:|---:|\n";
    for (const GlossyRow& row : rows)
        text += row.missing.empty() ? fmt::format("| {} | {} | {:.4f} | {:.3f} | {:.4f} |\n", row.scene, row.glossy,
                                                  row.error.rmse, row.error.ratio.mean, row.error.flip)
                                    : fmt::format("| {} | {} | | | |\n", row.scene, row.missing);
    return text;
}

}  // namespace probegi::accuracy
