#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "probegi/masks.h"
#include "scene_setup.h"

namespace probegi::tool {

/// --leak-guard and how masks are baked.
struct MaskOptions {
    LeakGuard guard = LeakGuard::moments;  ///< of --method ddgi: all but none
    std::optional<int> clusters, factor;   ///< --clusters, --mask-factor
    bool strict = false;                   ///< --mask-strict
    double budget = 0;                     ///< --mask-budget, ms a picture; 0: no limit

    bool bakes() const noexcept { return guard == LeakGuard::masks; }
};

/// What a command makes of them.
struct MaskOptionsOf {
    bool shortNames = false;  ///< --factor and --strict too, for a command that is about masks
    bool sdfShadow = false;   ///< it has the primitives for --leak-guard sdf-shadow
    bool moves = false;       ///< it has --animate
};
void addMaskOptions(CLI::App& command, MaskOptions& options, MaskOptionsOf offered = {});

/// Throws CLI::ValidationError where masks are not looked up, but options for them were given, and where they are to be
/// baked for cascades.
void checkMaskOptions(const MaskOptions& options, const VolumeOptions& volumes);

/// How masks will be baked.
MaskDesc maskDesc(const MaskOptions& options, std::uint64_t seed);

/// What a bake for a field is told, and what that refers to.
struct MaskPlan {
    MaskDesc desc;
    std::vector<Bounds> occluders;
    std::vector<glm::vec3> positions;
};

/// With relocation a new field gets an update first, which places its probes. Errors: those of Field::update.
Result<std::unique_ptr<MaskPlan>> planMasks(Field& field, const Tracer& tracer, const LoadedSetup& setup,
                                            const MaskOptions& options);

/// Has a field use masks from now on.
Result<void> useMasks(Field& field, std::shared_ptr<const Masks> masks);

/// Bakes masks for a field, in place of those that it may have, and has it use them from now on. Errors: those of
/// planMasks() and bakeMasks().
Result<void> bakeMasksFor(Field& field, const Context& context, const Tracer& tracer, const LoadedSetup& setup,
                          const MaskOptions& options);

}  // namespace probegi::tool
