#include "sdf_scene.h"

#include <fmt/format.h>

#include "console/output.h"

namespace probegi::tool {

void addSdfOption(CLI::App& command, SceneOptions& options) {
    command
        .add_option("--sdf", options.sdf,
                    "what the rays of probes hit instead of the scene's triangles: boxes, spheres and the like that "
                    "stand for them (docs/sdf.md)")
        ->type_name("FILE");
}

namespace {

/// Primitives that ride on nodes are in their nodes' frames, wherever the scene is.
void shift(SdfScene& sdf, glm::vec3 by) {
    for (SdfPrimitive& primitive : sdf.primitives)
        if (primitive.node.empty()) primitive.centre += by;
}

}  // namespace

Result<SdfScene> loadSdfOf(const Scene& scene, const std::filesystem::path& path, const ReadLimits& limits) {
    auto sdf = loadSdf(path, limits);
    if (sdf) shift(*sdf, -scene.origin);
    return sdf;
}

Result<void> saveSdfOf(const Scene& scene, const std::filesystem::path& path, SdfScene sdf) {
    shift(sdf, scene.origin);
    return saveSdf(path, sdf);
}

Result<void> readSdf(LoadedSetup& setup, const SceneOptions& options) {
    if (options.sdf.empty()) return {};
    auto sdf = loadSdfOf(*setup.scene, options.sdf, options.limits);
    if (!sdf) return sdf.error();
    if (sdf->primitives.empty())
        printWarning(
            fmt::format("{} has no primitives: {}", options.sdf,
                        options.probesHitMesh ? "they shade nothing" : "the rays of probes meet only the sky"));
    setup.sdf = std::move(*sdf);
    setup.probesHitSdf = !options.probesHitMesh;
    setup.files.emplace_back(options.sdf);
    return {};
}

Result<std::unique_ptr<MovableTracer>> openProbeTracer(const Backend& backend, const LoadedSetup& setup,
                                                       const ScenePose& pose) {
    if (!setup.probesHitSdf) return std::unique_ptr<MovableTracer>();
    auto tracer = backend.openSdf(*setup.sdf, *setup.scene, pose);
    if (!tracer) return fail(tracer.error().code, fmt::format("--sdf: {}", tracer.error().message));
    return tracer;
}

Result<void> placeGuard(FieldSettings& settings, const LoadedSetup& setup, const ScenePose& pose) {
    if (settings.guard != LeakGuard::sdfShadow) return {};
    auto placed = placeSdf(*setup.sdf, *setup.scene, pose);
    if (!placed) return fail(placed.error().code, fmt::format("--sdf: {}", placed.error().message));
    settings.blockers = std::move(*placed);
    return {};
}

std::size_t sdfBytes(const SdfScene& sdf) {
    return kSdfPrimitiveBytes * sdf.primitives.size();
}

}  // namespace probegi::tool
