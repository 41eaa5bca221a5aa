#include <string>

#include "scene/checks.h"

namespace probegi {

using namespace checks;

namespace {

/// Products of finite transforms can still overflow; the world must fit into floats with room for squares.
Result<void> validateExtent(const Scene& scene) {
    constexpr float kLimit = 1e9f;
    const auto inside = [](glm::vec3 v, float limit) {
        return within(v.x, -limit, limit) && within(v.y, -limit, limit) && within(v.z, -limit, limit);
    };
    const ScenePose pose = poseAt(scene);
    for (const Instance& instance : pose.instances) {
        // So far below the largest float that the bounds cannot overflow, hence are never NaN.
        for (int column = 0; column < 4; ++column) {
            if (inside(glm::vec3(instance.toWorld[column]), 1e18f)) continue;
            const std::size_t node = std::size_t(instance.node);
            return malformed(title("node", node, scene.nodes[node].name),
                             ": its transform multiplied with its parents' is too large (",
                             text(instance.toWorld[column]), ")");
        }
    }
    const Bounds& b = pose.bounds;
    if (!inside(b.lower, kLimit) || !inside(b.upper, kLimit)) {
        return malformed("the scene's triangles reach from ", text(b.lower), " to ", text(b.upper),
                         "; coordinates beyond ", kLimit, " m are not supported");
    }
    return {};
}

// Adds the grid's probes to `probes`.
Result<void> validateGrid(const std::string& name, const VolumeDesc& grid, std::int64_t& probes) {
    if (!finite(grid.origin)) return malformed(name, ": origin ", text(grid.origin), " must be finite");
    if (!finite(grid.spacing) || grid.spacing.x <= 0 || grid.spacing.y <= 0 || grid.spacing.z <= 0) {
        return malformed(name, ": spacing ", text(grid.spacing), " must be finite and > 0");
    }
    std::int64_t product = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const int count = grid.counts[axis];
        if (count < 2 || count > 1024) {
            return malformed(name, ": ", count, " probes along axis ", "xyz"[axis], " must be 2..1024");
        }
        product *= count;
    }
    probes += product;
    if (probes > (1 << 24)) return malformed(name, ": ", probes, " probes are more than 2^24; use fewer");
    return {};
}

Result<void> validateGrids(const Scene& scene) {
    constexpr std::size_t kMostFurther = 31;
    if (scene.furtherGrids.size() > kMostFurther) {
        return malformed("scene: ", scene.furtherGrids.size() + 1, " probe grids are more than ", kMostFurther + 1);
    }
    if (!scene.grid) {
        return scene.furtherGrids.empty() ? Result<void>() : malformed("scene: further probe grids without a first");
    }
    std::int64_t probes = 0;
    if (auto ok = validateGrid("probe grid", *scene.grid, probes); !ok) return ok;
    for (std::size_t i = 0; i < scene.furtherGrids.size(); ++i) {
        const std::string name = "probe grid " + std::to_string(i + 1);
        if (auto ok = validateGrid(name, scene.furtherGrids[i], probes); !ok) return ok;
    }
    return {};
}

}  // namespace

Result<void> validateSurroundings(const Scene& scene) {
    const Sky& sky = scene.sky;
    if (!energy(sky.radiance)) return malformed("sky: radiance ", text(sky.radiance), " must be 0 to ", kBrightest);
    const HdrImage& image = sky.image;
    if (image.width < 0 || image.height < 0 || image.pixels.size() != std::size_t(image.width) * image.height) {
        return malformed("sky image: ", image.pixels.size(), " pixels are not ", image.width, " x ", image.height);
    }
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (!energy(image.pixels[i]) || !energy(image.pixels[i] * sky.radiance)) {
            return malformed("sky image: pixel ", i, " is ", text(image.pixels[i]), " times ", text(sky.radiance),
                             "; radiance must be 0 to ", kBrightest);
        }
    }
    if (!finite(scene.exposure) || scene.exposure <= 0) {
        return malformed("scene: exposure ", scene.exposure, " must be finite and > 0");
    }
    return validateGrids(scene);
}

Result<void> validate(const Scene& scene) {
    using Check = Result<void> (*)(const Scene&);
    constexpr Check kChecks[] = {validateImages, validateMaterials,  validateMeshes,       validateLightsAndCameras,
                                 validateNodes,  validateAnimations, validateSurroundings, validateExtent};
    for (const Check check : kChecks) {
        if (auto result = check(scene); !result) return result;
    }
    return {};
}

}  // namespace probegi
