#include "mask_options.h"

#include <fmt/format.h>

#include <map>

#include "console/parse.h"

namespace probegi::tool {

namespace {

/// Clusters of --mask-strict, where --clusters does not say: with fewer, many places see none.
constexpr int kStrictClusters = 6;

}  // namespace

void addMaskOptions(CLI::App& command, MaskOptions& options) {
    constexpr const char* kGroup = "Masks";
    static const std::map<std::string, LeakGuard> kGuards{{"moments", LeakGuard::moments}, {"masks", LeakGuard::masks}};
    command
        .add_option("--leak-guard", options.guard,
                    "which probes a point may use, with --method ddgi: by the distances that they store (moments, the "
                    "default), or by visibility that is baked first, for scenes that stand still (masks)")
        ->type_name("moments|masks")
        ->transform(oneOf(kGuards))
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
            "--mask-factor", options.factor,
            fmt::format("mask texels along the edge of a cell of probes, 2 to 16 (default {})", MaskDesc{}.factor))
        ->type_name("N")
        ->check(inRange(2, 16))
        ->group(kGroup);
    command
        .add_flag("--mask-strict", options.strict,
                  "a point uses a cluster only where it sees all its probes: nothing leaks, more is unlit by probes "
                  "that it could see")
        ->group(kGroup);
}

void checkMaskOptions(const MaskOptions& options) {
    if (!options.bakes() && (options.clusters || options.factor || options.strict))
        throw CLI::ValidationError("--clusters, --mask-factor, --mask-strict", "they act on --leak-guard masks only");
}

Result<void> bakeMasksFor(Field& field, const Context& context, const Tracer& tracer, const LoadedSetup& setup,
                          const MaskOptions& options) {
    MaskDesc desc;
    desc.strict = options.strict;
    desc.clusters = options.clusters.value_or(options.strict ? kStrictClusters : desc.clusters);
    desc.factor = options.factor.value_or(desc.factor);
    desc.seed = field.desc().seed;
    const std::vector<Bounds> occluders = triangleBounds(*setup.scene, setup.pose);
    desc.occluders = occluders;
    std::vector<glm::vec3> positions;
    if (field.desc().relocation) {
        if (auto updated = field.update(tracer, setup.lighting); !updated) return updated.error();
        for (int slot = 0; slot < probeCount(field.desc()); ++slot)
            positions.push_back(field.control().probePosition(slot));
    }
    desc.positions = positions;
    auto masks = bakeMasks(context, tracer, field.desc(), desc);
    if (!masks) return masks.error();
    FieldSettings settings = field.control().settings();
    settings.guard = LeakGuard::masks;
    settings.masks = std::move(*masks);
    return field.control().setSettings(settings);
}

}  // namespace probegi::tool
