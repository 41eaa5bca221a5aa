#pragma once

#include <string>
#include <vector>

#include "probegi/measure.h"

namespace probegi::accuracy {

/// A camera that flies along the longest side of a scene, with cascades around it, and an update a frame.
struct FlightDesc {
    CascadeDesc cascades{};  ///< around the camera, wherever that is
    int rays = FieldDesc{}.raysPerProbe;
    int frames = 60;
    int settle = 30;               ///< updates before the flight
    float metresPerFrame = 0.05f;  ///< 3 m/s at 60 frames a second
    int points = 2000;             ///< at surfaces; they stand still
};

/// How light at points that stand still changes from frame to frame, as a share of the mean light of all points.
struct Change {
    double largest = 0;  ///< of all points and frames
    double high = 0;     ///< their 99.9th percentile
};

struct FlightResult {
    std::string scene;
    int probes = 0;
    int levels = 0;
    int leaps = 0;          ///< of windows, in all
    Change aware{};         ///< volumes blend around the camera
    Change unaware{};       ///< the same probes, blended as if nothing tracked the camera
    Change still{};         ///< the camera stands still: the probes' own noise
    std::string missing{};  ///< why the scene could not be measured; empty: it was
};

/// Errors: those of Field and the tracer.
Result<FlightResult> measureFlight(const Context& context, const std::string& name, const Scene& scene,
                                   const FlightDesc& desc);

/// The table for docs/accuracy.md, with its heading.
std::string flightTable(const std::vector<FlightResult>& rows);

}  // namespace probegi::accuracy
