#include "scene/checks.h"

namespace probegi {

using namespace checks;

namespace {

/// Finite values can still overflow where transforms multiply; the world must fit into floats with room for squares.
Result<void> validateExtent(const Scene& scene) {
    constexpr float kLimit = 1e9f;
    const auto inside = [](glm::vec3 v, float limit) {
        return within(v.x, -limit, limit) && within(v.y, -limit, limit) && within(v.z, -limit, limit);
    };
    const ScenePose pose = poseAt(scene);
    for (const Instance& instance : pose.instances) {
        // So far below the largest float that the bounds below are sums without overflow, hence never NaN.
        for (int column = 0; column < 4; ++column) {
            if (inside(glm::vec3(instance.toWorld[column]), 1e18f)) continue;
            const std::size_t node = std::size_t(instance.node);
            return malformed("{}: its transform multiplied with its parents' is too large ({})",
                             title("node", node, scene.nodes[node].name), text(instance.toWorld[column]));
        }
    }
    const Bounds& b = pose.bounds;
    if (!inside(b.lower, kLimit) || !inside(b.upper, kLimit)) {
        return malformed("the scene's triangles reach from {} to {}; coordinates beyond {:g} m are not supported",
                         text(b.lower), text(b.upper), kLimit);
    }
    return {};
}

}  // namespace

Result<void> validateSurroundings(const Scene& scene) {
    const Sky& sky = scene.sky;
    if (!energy(sky.radiance)) return malformed("sky: radiance {} must be 0 to {:g}", text(sky.radiance), kBrightest);
    const HdrImage& image = sky.image;
    if (image.width < 0 || image.height < 0 || image.pixels.size() != std::size_t(image.width) * image.height) {
        return malformed("sky image: {} pixels do not make {} x {}", image.pixels.size(), image.width, image.height);
    }
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (!energy(image.pixels[i]) || !energy(image.pixels[i] * sky.radiance)) {
            return malformed("sky image: pixel {} is {} times {}; radiance must be 0 to {:g}", i, text(image.pixels[i]),
                             text(sky.radiance), kBrightest);
        }
    }
    if (!finite(scene.exposure) || scene.exposure <= 0) {
        return malformed("scene: exposure {:g} must be finite and > 0", scene.exposure);
    }
    if (!scene.grid) return {};
    const GridDesc& grid = *scene.grid;
    if (!finite(grid.origin)) return malformed("probe grid: origin {} must be finite", text(grid.origin));
    if (!finite(grid.spacing) || grid.spacing.x <= 0 || grid.spacing.y <= 0 || grid.spacing.z <= 0) {
        return malformed("probe grid: spacing {} must be finite and > 0", text(grid.spacing));
    }
    std::int64_t product = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const int count = grid.counts[axis];
        if (count < 2 || count > 1024) {
            return malformed("probe grid: {} probes along axis {} must be 2..1024", count, "xyz"[axis]);
        }
        product *= count;
    }
    if (product > (1 << 24)) return malformed("probe grid: {} probes are more than 2^24; use fewer", product);
    return {};
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
