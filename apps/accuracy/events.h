#pragma once

#include <string>
#include <vector>

#include "probegi/edits.h"
#include "probegi/measure.h"

namespace probegi::accuracy {

/// How a field follows one change of a scene with update().
struct EventRow {
    std::string change;  ///< "lamp on", ...
    std::string scene;
    FieldRules rules = FieldRules::measured;
    bool told = false;         ///< whether the field was told of the edits that findEdits() found
    int edits = 0;             ///< that were found
    double probesTold = 0;     ///< share of the probes inside the edits' regions
    int arrives = 0;           ///< updates until a tenth of the change is left for the first time; -1: never
    int stays = 0;             ///< the same for good
    double errorAfterTen = 0;  ///< RMS difference from the goal ten updates after the change, over the goal's mean
};

/// Lamp on, lamp off, sun jump, wall removed, door opened; with each of the rules, told and not. Errors: those of
/// Field.
Result<std::vector<EventRow>> measureEvents(const Context& context);

/// The table for docs/accuracy.md, with its heading.
std::string eventTable(const std::vector<EventRow>& rows);

}  // namespace probegi::accuracy
