#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "probegi/field.h"
#include "probegi/image.h"
#include "probegi/scene.h"
#include "probegi/snapshot.h"

namespace probegi::tool {

/// What a view may show of a probe.
struct ShownProbe {
    const ProbeState& state;
    int age = 0;  ///< FieldControl::updateAge
};

/// A place on a surface that a view colours.
struct ShownPoint {
    glm::vec3 position;  ///< metres, in the world
    glm::vec3 normal, toViewer;
};

/// In what colours probes shine while a view is drawn, instead of in the light that they know.
enum class Paint { none, probes, clusters };

/// A picture of what a field does at the surfaces that a camera sees, or of its probes as balls: --debug NAME. A new
/// one is a row of debugViews(). Colours are display values, 0..1.
struct DebugView {
    const char* name;
    const char* help;
    bool needsLight;                                       ///< the probes must have been updated
    glm::vec3 (*colour)(const Field&, const ShownPoint&);  ///< of a surface; null: grey
    glm::vec3 (*ball)(const ShownProbe&);                  ///< of a probe; null: probes are not shown
    bool primitives = false;  ///< colours those of --sdf that the camera sees; the surface where there is none is grey
    Paint paint = Paint::none;
};

std::span<const DebugView> debugViews();

/// The view of a name; null: there is none.
const DebugView* findDebugView(const std::string& name);

/// Draws a view, with some shading so that shapes can be told; linear values, of which a PNG shows `colour`. Sky is
/// black. The field is afterwards as it was. `primitives`: a tracer of --sdf; null: none. Errors: invalidArgument
/// (clusters without masks), outOfMemory, and those of the tracers and of Field::write.
Result<HdrImage> drawDebugView(const DebugView& view, Field& field, const Tracer& tracer, const Tracer* primitives,
                               const PlacedCamera& camera, int width, int height);

}  // namespace probegi::tool
