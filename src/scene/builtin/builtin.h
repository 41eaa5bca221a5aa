#pragma once

#include "probegi/builtin_scenes.h"

/// The makers behind makeBuiltinScene(), one file each.
namespace probegi::builtin {

Result<Scene> makeCornell(const BuiltinParams& params);
Result<Scene> makeFurnace(const BuiltinParams& params);
Result<Scene> makeSphere(const BuiltinParams& params);
Result<Scene> makeTwoRooms(const BuiltinParams& params);
Result<Scene> makeDarkRoom(const BuiltinParams& params);
Result<Scene> makeDoor(const BuiltinParams& params);
Result<Scene> makeMoving(const BuiltinParams& params);
Result<Scene> makeMirrors(const BuiltinParams& params);
Result<Scene> makeDesk(const BuiltinParams& params);
Result<Scene> makeHouse(const BuiltinParams& params);
Result<Scene> makeTerrain(const BuiltinParams& params);
Result<Scene> makeAtrium(const BuiltinParams& params);

/// invalidArgument unless lower <= value <= upper (never for NaN).
Result<void> requireWithin(std::string_view parameter, float value, float lower, float upper);
/// invalidArgument unless value is finite and > 0.
Result<void> requirePositive(std::string_view parameter, float value);

}  // namespace probegi::builtin
