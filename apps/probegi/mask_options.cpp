#include "mask_options.h"

#include <fmt/format.h>

#include <map>

#include "console/parse.h"

namespace probegi::tool {

namespace {

/// Clusters of --mask-strict, where --clusters does not say: with fewer, many places see none.
constexpr int kStrictClusters = 6;

}  // namespace

void addMaskOptions(CLI::App& command, MaskOptions& options, MaskOptionsOf offered) {
    constexpr const char* kGroup = "Masks";
    const bool shortNames = offered.shortNames;
    std::map<std::string, LeakGuard> guards{{"moments", LeakGuard::moments}, {"masks", LeakGuard::masks}};
    if (offered.sdfShadow) guards.emplace("sdf-shadow", LeakGuard::sdfShadow);
    command
        .add_option("--leak-guard", options.guard,
                    fmt::format("which probes a point may use, with --method ddgi: by the distances that they store "
                                "(moments), by visibility that is baked first{} (default {})",
                                offered.sdfShadow
                                    ? ", with --animate again for each picture in which things have moved (masks), or "
                                      "by the shadows of the primitives of --sdf between points and probes (sdf-shadow)"
                                    : " (masks)",
                                options.bakes() ? "masks" : "moments"))
        ->type_name(offered.sdfShadow ? "moments|masks|sdf-shadow" : "moments|masks")
        ->transform(oneOf(guards))
        ->group(kGroup);
    command
        .add_option("--clusters", options.clusters,
                    fmt::format("clusters of the probes, 1 to 8: with more, a point sees more of them apart (default "
                                "{}, with --mask-strict {})",
                                MaskDesc{}.clusters, kStrictClusters))
        ->type_name("K")
        ->check(inRange(1, 8))
        ->group(kGroup);
    command
        .add_option(
            shortNames ? "--factor,--mask-factor" : "--mask-factor", options.factor,
            fmt::format("mask texels along the edge of a cell of probes, 2 to 16 (default {})", MaskDesc{}.factor))
        ->type_name("N")
        ->check(inRange(2, 16))
        ->group(kGroup);
    command
        .add_flag(shortNames ? "--strict,--mask-strict" : "--mask-strict", options.strict,
                  "a point uses a cluster only where it sees all its probes: nothing leaks, more is unlit by probes "
                  "that it could see")
        ->group(kGroup);
}

void checkMaskOptions(const MaskOptions& options, const VolumeOptions& volumes) {
    if (!options.bakes() && (options.clusters || options.factor || options.strict))
        throw CLI::ValidationError("--clusters, --mask-factor, --mask-strict", "they act on --leak-guard masks only");
    if (options.bakes() && volumes.cascades > 0)
        throw CLI::ValidationError("--leak-guard",
                                   "masks are baked for probes that stand still, without --cascades; with them give "
                                   "--leak-guard moments");
}

MaskDesc maskDesc(const MaskOptions& options, std::uint64_t seed) {
    MaskDesc desc;
    desc.strict = options.strict;
    desc.clusters = options.clusters.value_or(options.strict ? kStrictClusters : desc.clusters);
    desc.factor = options.factor.value_or(desc.factor);
    desc.seed = seed;
    return desc;
}

Result<void> bakeMasksFor(Field& field, const Context& context, const Tracer& tracer, const LoadedSetup& setup,
                          const MaskOptions& options) {
    MaskDesc desc = maskDesc(options, field.desc().seed);
    const std::vector<Bounds> occluders = triangleBounds(*setup.scene, setup.pose);
    desc.occluders = occluders;
    std::vector<glm::vec3> positions;
    if (field.desc().relocation && field.control().frame() == 0) {
        if (auto updated = field.update(tracer, setup.lighting); !updated) return updated.error();
    }
    if (field.desc().relocation)
        for (int slot = 0; slot < probeCount(field.desc()); ++slot)
            positions.push_back(field.control().probePosition(slot));
    desc.positions = positions;
    auto masks = bakeMasks(context, tracer, field.desc(), desc);
    if (!masks) return masks.error();
    FieldSettings settings = field.control().settings();
    settings.guard = LeakGuard::masks;
    settings.masks = std::move(*masks);
    return field.control().setSettings(settings);
}

}  // namespace probegi::tool
