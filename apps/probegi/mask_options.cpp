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
                                    ? ", and with --animate follows what moves (masks), or "
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
    if (!offered.moves) return;
    command
        .add_option("--mask-budget", options.budget,
                    "with --animate: how long masks of what moves may take in each picture, in milliseconds, as in an "
                    "engine; what is left waits for the next one, which still shows the last whole masks (default: as "
                    "long as they take)")
        ->type_name("MS")
        ->check(inRange(0.1, 10000.0))
        ->group(kGroup);
}

void checkMaskOptions(const MaskOptions& options, const VolumeOptions& volumes) {
    if (!options.bakes() && (options.clusters || options.factor || options.strict || options.budget > 0))
        throw CLI::ValidationError("--clusters, --mask-factor, --mask-strict, --mask-budget",
                                   "they act on --leak-guard masks only");
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

Result<std::unique_ptr<MaskPlan>> planMasks(Field& field, const Tracer& tracer, const LoadedSetup& setup,
                                            const MaskOptions& options) {
    auto plan = std::make_unique<MaskPlan>();
    plan->desc = maskDesc(options, field.desc().seed);
    plan->occluders = triangleBounds(*setup.scene, setup.pose);
    plan->desc.occluders = plan->occluders;
    if (!field.desc().relocation) return plan;
    if (field.control().frame() == 0)
        if (auto updated = field.update(tracer, setup.lighting); !updated) return updated.error();
    for (int slot = 0; slot < probeCount(field.desc()); ++slot)
        plan->positions.push_back(field.control().probePosition(slot));
    plan->desc.positions = plan->positions;
    return plan;
}

Result<void> useMasks(Field& field, std::shared_ptr<const Masks> masks) {
    FieldSettings settings = field.control().settings();
    settings.guard = LeakGuard::masks;
    settings.masks = std::move(masks);
    return field.control().setSettings(settings);
}

Result<void> bakeMasksFor(Field& field, const Context& context, const Tracer& tracer, const LoadedSetup& setup,
                          const MaskOptions& options) {
    const auto plan = planMasks(field, tracer, setup, options);
    if (!plan) return plan.error();
    auto masks = bakeMasks(context, tracer, field.desc(), (*plan)->desc);
    if (!masks) return masks.error();
    return useMasks(field, std::move(*masks));
}

}  // namespace probegi::tool
