#include "probegi/measure.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "console/output.h"
#include "console/parse.h"
#include "console/terminal.h"
#include "field_text.h"

namespace probegi::tool {

namespace {

struct CompareOptions {
    std::string test, reference;
    std::string heatmap;
    bool json = false;
    std::optional<float> exposure;  ///< --exposure; none: 1
    ReadLimits limits;
};

void print(const ImageDifference& d, bool json) {
    const LightRatio& r = d.ratio;
    if (json) {
        const nlohmann::ordered_json ratio{
            {"mean", r.mean}, {"p5", r.low}, {"median", r.median}, {"p95", r.high}, {"blocks", r.blocks}};
        fmt::print("{}", jsonText({{"rmse", d.rmse},
                                   {"relmse", d.relmse},
                                   {"scaledRelmse", d.scaledRelmse},
                                   {"flip", d.flip},
                                   {"ratio", ratio}}));
        return;
    }
    fmt::print(
        "rmse    {:.6f}   root mean square error of display values, 0..1\n"
        "relmse  {:.6f}   mean relative square error of linear values\n"
        "scaled  {:.6f}   the same, relative to the reference's own brightness where it is dark\n"
        "flip    {:.6f}   mean visible difference (FLIP), 0..1\n",
        d.rmse, d.relmse, d.scaledRelmse, d.flip);
    if (r.blocks == 0)
        fmt::print("ratio   -          of the light, A over B: B is black\n");
    else
        fmt::print(
            "ratio   {:.6f}   of the light, A over B; in {} blocks {:.3f}, {:.3f}, {:.3f} (5th, 50th, 95th "
            "percentile)\n",
            r.mean, r.blocks, r.low, r.median, r.high);
}

Result<void> compareFieldsOf(const CompareOptions& options) {
    for (const std::string& file : {options.test, options.reference})
        if (!isFieldFile(file))
            return fail(
                ErrorCode::invalidArgument,
                fmt::format("'{}' is no field, and the other one is; compare two fields or two pictures", file));
    if (!options.heatmap.empty())
        return fail(ErrorCode::invalidArgument, "--heatmap shows where pictures differ; fields have none");
    if (options.exposure)
        return fail(ErrorCode::invalidArgument, "--exposure acts on pictures; fields are compared as they are");
    return compareFieldFiles(options.test, options.reference, options.json, options.limits);
}

Result<void> compare(const CompareOptions& options) {
    if (isFieldFile(options.test) || isFieldFile(options.reference)) return compareFieldsOf(options);
    const bool writesMap = !options.heatmap.empty();
    Outputs outputs;
    if (writesMap)
        if (auto claimed = outputs.claim("--heatmap", options.heatmap, pictureExtensions()); !claimed) return claimed;
    if (auto apart = outputs.keepApartFrom({options.test, options.reference}); !apart) return apart;
    const auto test = readImage(options.test, options.limits);
    if (!test) return test.error();
    const auto reference = readImage(options.reference, options.limits);
    if (!reference) return reference.error();
    if (test->width != reference->width || test->height != reference->height)
        return fail(
            ErrorCode::invalidArgument,
            fmt::format("'{}' is {}x{} and '{}' is {}x{}; pictures must be of one size to be compared", options.test,
                        test->width, test->height, options.reference, reference->width, reference->height));
    const auto comparison = compareImages(*test, *reference, ToneMap{options.exposure.value_or(1.0f), false});
    if (!comparison) return comparison.error();
    if (writesMap) {
        const HdrImage map = linearFromDisplay(heatmap(comparison->flipMap));
        if (auto written = writeImage(options.heatmap, map); !written) return written;
    }
    print(comparison->difference, options.json);
    return {};
}

}  // namespace

void addCompareCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand(
        "compare", "measure how far a picture is from a reference picture, or a field's probes from another's");
    const auto options = std::make_shared<CompareOptions>();
    command
        ->add_option("A", options->test, "the picture to test: .exr, .hdr, .png or .jpg; or a field of 'probegi bake'")
        ->type_name("")
        ->required();
    command->add_option("B", options->reference, "the reference, of the same size; or a field with the same volumes")
        ->type_name("")
        ->required();
    command->add_option("--heatmap", options->heatmap, "write where they differ (FLIP, dark to bright): .png or .exr")
        ->type_name("FILE");
    command->add_flag(
        "--json", options->json,
        "print JSON with the keys rmse, relmse, scaledRelmse, flip and ratio; of fields probes, mean, rms, ratio, "
        "worst, worstSlot, equalMaps, equalStates, equalMasks and equalSettings");
    command
        ->add_option("--exposure", options->exposure,
                     "factor on the light before display values are compared (default 1)")
        ->type_name("FACTOR")
        ->check(inRange(1e-9, 1e9));
    addUnpackLimit(*command, options->limits);
    command->footer(
        "Example: probegi compare field.exr reference.exr --heatmap difference.png\n"
        "Example: probegi compare house.field other.field");
    command->callback([options, &exitCode] {
        if (const auto done = compare(*options); !done) exitCode = printError(done.error());
    });
}

}  // namespace probegi::tool
