#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "probegi/masks.h"
#include "scene_setup.h"

namespace probegi::tool {

/// --leak-guard and how masks are baked.
struct MaskOptions {
    LeakGuard guard = LeakGuard::moments;  ///< of --method ddgi: moments or masks
    std::optional<int> clusters, factor;   ///< --clusters, --mask-factor
    bool strict = false;                   ///< --mask-strict

    bool bakes() const noexcept { return guard == LeakGuard::masks; }
};

void addMaskOptions(CLI::App& command, MaskOptions& options);

/// Throws CLI::ValidationError where masks are not looked up, but options for them were given.
void checkMaskOptions(const MaskOptions& options);

/// Bakes the masks of a field that has other guards so far, and has it use them from now on. With relocation the field
/// gets an update first, which places its probes. Errors: those of Field::update and bakeMasks.
Result<void> bakeMasksFor(Field& field, const Context& context, const Tracer& tracer, const LoadedSetup& setup,
                          const MaskOptions& options);

}  // namespace probegi::tool
