#pragma once

#include <string>
#include <vector>

#include "probegi/context.h"
#include "probegi/masks.h"

namespace probegi::accuracy {

/// Masks that follow a door that opens and shuts, and what they let through meanwhile.
struct DoorRow {
    MaskDesc masks{};
    double bakeSeconds = 0;            ///< of a full bake
    double meanMs = 0, mostMs = 0;     ///< of MaskUpdater::move() and update() in a frame, while the door moves
    int behind = 0;                    ///< frames after the door has stopped until masks are those of the open door
    double leak = 0;                   ///< light that comes through what is shut, worst frame
    double stale = 0;                  ///< the same, had the masks stayed those of the open door
    double atDoor = 0, elsewhere = 0;  ///< open: RMS from the masks of a full bake, over the mean light
    double seedAtDoor = 0, seedElsewhere = 0;  ///< the same of full bakes with two seeds
    double shut = 0;                           ///< shut again: RMS from the first masks
};

/// builtin:house at night, a lamp in its kitchen, and a door to the study that swings open and shut. Errors: those of
/// the field and the bakes.
Result<std::vector<DoorRow>> measureDoors(const Context& context);

/// The table for docs/accuracy.md, with its heading.
std::string doorTable(const std::vector<DoorRow>& rows);

}  // namespace probegi::accuracy
