#pragma once

#include <span>
#include <vector>

#include "probegi/context.h"
#include "probegi/field.h"
#include "reference/path_guide.h"
#include "reference/transport.h"

namespace probegi {

/// A surface point at which paths scatter.
struct GuideReceiver {
    glm::vec3 position{0.0f};
    glm::vec3 geometricNormal{0, 1, 0};
    glm::vec3 normal{0, 1, 0};  ///< shading normal
    std::uint32_t region = 0;
};

/// Light that a receiver sees in one direction; boxes are built from these.
struct GuideLight {
    glm::vec3 position{0.0f};  ///< of the lit surface, or of the opening through which the sky is seen
    float distance = 0;        ///< from the receiver
    float radiance = 0;        ///< luminance
    std::uint32_t receiver = 0;
    bool sky = false;
};

/// What the receivers saw along their kRaysPerReceiver cosine-distributed rays each.
struct GuideLessons {
    static constexpr int kRaysPerSide = 16;
    static constexpr int kRaysPerReceiver = kRaysPerSide * kRaysPerSide;

    std::vector<GuideReceiver> receivers;  ///< by region
    std::vector<GuideLight> lights;        ///< by receiver
    std::vector<float> background;         ///< per receiver: sum of the radiances that are not a GuideLight
    std::vector<float> backgroundSquares;  ///< per receiver: sum of their squares
    std::vector<float> levels;             ///< per region: mean incoming radiance according to the field; negative:
                                           ///< unknown
};

/// The points where camera rays hit surfaces. Errors: those of the tracer.
Result<std::vector<GuideReceiver>> receiversSeen(const Transport& transport, std::span<const Ray> rays);

/// Traces paths from the first receivers on, so that lessons are where paths go, and samples the light there. Emissive
/// surfaces are ignored, since light sampling finds them. Errors: those of the field's query.
Result<GuideLessons> takeLessons(const Context& context, const Transport& transport, const Field& field,
                                 const PathGuide& guide, std::vector<GuideReceiver> first, std::uint64_t seed);

}  // namespace probegi
