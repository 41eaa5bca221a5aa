#pragma once

#include <string>
#include <vector>

#include "probegi/measure.h"
#include "scene_setup.h"

namespace probegi::accuracy {

/// One picture against the path tracer with all of its light.
struct GlossyRow {
    std::string scene;
    std::string glossy;  ///< "off", "first", "field"; "exact": the score of the reference's own noise
    ImageDifference error{};
    std::string missing{};  ///< why the scene could not be measured; empty: it was
};

/// Pictures of a setup with each value of PictureDesc::glossy, lit by its converged field. Errors: those of the field,
/// the tracers and the pictures.
Result<std::vector<GlossyRow>> measureGlossy(const Context& context, const std::string& name,
                                             const tool::LoadedSetup& setup, int samplesPerPixel);

/// The table for docs/accuracy.md, with its heading.
std::string glossyTable(const std::vector<GlossyRow>& rows);

}  // namespace probegi::accuracy
