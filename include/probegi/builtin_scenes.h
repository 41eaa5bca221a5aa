#pragma once

#include <span>
#include <string_view>

#include "probegi/export.h"
#include "probegi/scene.h"

namespace probegi {

/// A scene made by code: no files needed.
struct BuiltinScene {
    std::string_view name;         ///< as in `builtin:NAME`
    std::string_view description;  ///< one line
};

/// All built-in scenes, in the order in which they are best looked at.
PROBEGI_API std::span<const BuiltinScene> builtinScenes();

/// Parameters that some built-in scenes take; those that do not use one ignore it.
struct BuiltinParams {
    float wallThickness = 0.10f;  ///< metres, 0.02..0.30 (two-rooms, dark-room)
    float albedo = 0.5f;          ///< 0..0.99 (furnace, sphere)
    float emission = 1.0f;        ///< W sr^-1 m^-2, > 0 (furnace)
    float power = 100.0f;         ///< W (sphere)
    float radius = 1.0f;          ///< metres, > 0 (sphere)
};

/// Makes a built-in scene by name. Errors: invalidArgument (unknown name; the message lists the known ones; or a
/// parameter out of range).
PROBEGI_API Result<Scene> makeBuiltinScene(std::string_view name, const BuiltinParams& params = {});

}  // namespace probegi
