#pragma once

#include <string>
#include <vector>

#include "scene_setup.h"

namespace probegi::accuracy {

/// Irradiance of a picture's pixels over the path tracer's, of all or of some of them.
struct ContactError {
    double ratio = 0;  ///< of the sums
    double rms = 0;    ///< over the mean of the truth; its noise is subtracted
    double light = 0;  ///< share of these pixels in the light of all
    int points = 0;
};

/// A picture with or without contact light.
struct ContactRow {
    std::string scene;
    std::string run;  ///< "converge", or how many updates
    bool contact = false;
    ContactError all{}, nooks{};
    std::string missing{};  ///< why the scene could not be measured; empty: it was
};

/// Pictures of a setup with and without PictureDesc::contact, lit by a field after converge() and after update()s.
/// Errors: those of the field, the tracers and the pictures.
Result<std::vector<ContactRow>> measureContact(const Context& context, const std::string& name,
                                               const tool::LoadedSetup& setup, int pathsPerPoint);

/// The table for docs/accuracy.md, with its heading.
std::string contactTable(const std::vector<ContactRow>& rows);

}  // namespace probegi::accuracy
