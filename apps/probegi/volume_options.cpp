#include "volume_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "console/parse.h"

namespace probegi::tool {

namespace {

constexpr const char* kNearest = "nearest";

std::string checkOutside(std::string& text) {
    if (text == kNearest) return {};
    const auto radiance = parseVector(text);
    if (!radiance) return fmt::format("'{}' is neither nearest nor R,G,B", text);
    for (int c = 0; c < 3; ++c)
        if (!((*radiance)[c] >= 0 && (*radiance)[c] <= 1e20f))
            return fmt::format("'{}' is no radiance: each must be 0 to 1e20 W/sr/m2", text);
    return {};
}

// The finest spacing with which the coarsest volume answers everywhere in the scene.
float coveringSpacing(const VolumeOptions& options, glm::ivec3 counts, glm::vec3 camera, const Bounds& scene) {
    const glm::vec3 reach = glm::max(glm::abs(scene.lower - camera), glm::abs(scene.upper - camera));
    // In cells of the coarsest, whose last two on each side it does not answer alone (VolumeDesc::tracksCamera).
    const glm::vec3 cells = glm::max(0.5f * glm::vec3(counts - 1) - 2.0f, glm::vec3(0.5f));
    const glm::vec3 coarsest = reach / cells;
    return std::max({coarsest.x, coarsest.y, coarsest.z}) / std::exp2(float(options.cascades - 1));
}

}  // namespace

void addVolumeOptions(CLI::App& command, VolumeOptions& options, const std::vector<CLI::Option*>& otherPlacements) {
    constexpr const char* kGroup = "Probes";
    auto* cascades = command
                         .add_option("--cascades", options.cascades,
                                     "nested volumes around the camera, 1 to 8, each twice as coarse as the one inside "
                                     "it, in place of a grid over the scene")
                         ->type_name("N")
                         ->check(inRange(1, 8))
                         ->group(kGroup);
    for (CLI::Option* other : otherPlacements) cascades->excludes(other);
    command
        .add_option("--cascade-spacing", options.cascadeSpacing,
                    "metres between the finest cascade's probes (default: so that the coarsest covers the scene)")
        ->type_name("METRES")
        ->check(inRange(1e-6, 1e9))
        ->needs(cascades)
        ->group(kGroup);
    command.add_option("--cascade-probes", options.cascadeProbes, "probes per axis of each cascade, 5 or more")
        ->type_name("XxYxZ")
        ->check(parsedBy(parseCounts))
        ->needs(cascades)
        ->capture_default_str()
        ->group(kGroup);
    command
        .add_option("--outside", options.outside,
                    "light where no probes are: that of the nearest ones, or this radiance in W/sr/m2 from all sides, "
                    "to which it fades from half a cell beyond the outermost, with --cascades within the coarsest")
        ->type_name("nearest|R,G,B")
        ->check(CLI::Validator(checkOutside, ""))
        ->capture_default_str()
        ->group(kGroup);
}

Result<std::vector<VolumeDesc>> cascadesAround(const VolumeOptions& options, glm::vec3 camera, const Bounds& scene) {
    CascadeDesc desc;
    desc.centre = camera;
    desc.counts = *parseCounts(options.cascadeProbes);
    desc.levels = options.cascades;
    desc.spacing = glm::vec3(options.cascadeSpacing > 0 ? options.cascadeSpacing
                                                        : coveringSpacing(options, desc.counts, camera, scene));
    auto volumes = makeCascades(desc);
    if (volumes) return volumes;
    return fail(volumes.error().code, fmt::format("--cascades: {}", volumes.error().message));
}

FieldSettings fieldSettings(const VolumeOptions& options, const std::vector<VolumeDesc>& volumes, glm::vec3 camera) {
    FieldSettings settings;
    if (std::any_of(volumes.begin(), volumes.end(), [](const VolumeDesc& v) { return v.tracksCamera; }))
        settings.camera = camera;
    if (options.outside == kNearest) return settings;
    settings.outside = OutsideLight::fades;
    settings.outsideRadiance = *parseVector(options.outside);
    return settings;
}

}  // namespace probegi::tool
