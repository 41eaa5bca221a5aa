#pragma once

#include "probegi/field_file.h"
#include "render_options.h"

namespace probegi::tool {

/// Whether two fields are made and updated alike: all of their desc, and all settings but guard and masks.
bool sameSettings(const FieldDesc& aDesc, FieldSettings a, const FieldDesc& bDesc, const FieldSettings& b);

/// --field: excludes all options that say how probes are made. Call it when these are there.
void addFieldOption(CLI::App& command, RenderOptions& options);

/// Reads the file of --field and has the scene's setup take over its volumes. Errors: those of loadField.
Result<std::optional<SavedField>> readSavedField(RenderOptions& options);

/// Warns where the file is of another scene, or its light is of other lights and `updates` is false, so that it stays.
Result<void> warnOfOtherScene(const SavedField& saved, const LoadedSetup& setup, bool updates);

/// The field as it was saved, but for the guard of --method leaky. Errors: those of restoreField.
Result<Field> openSavedField(const Backend& backend, const SavedField& saved, Method method);

/// Whether the options ask for updates of a field that was read.
bool updatesSaved(const RenderOptions& options);

}  // namespace probegi::tool
