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

Result<void> readSdf(LoadedSetup& setup, const SceneOptions& options) {
    if (options.sdf.empty()) return {};
    auto sdf = loadSdf(options.sdf, options.limits);
    if (!sdf) return sdf.error();
    if (sdf->primitives.empty())
        printWarning(fmt::format("{} has no primitives: the rays of probes meet only the sky", options.sdf));
    for (SdfPrimitive& primitive : sdf->primitives)
        if (primitive.node.empty()) primitive.centre -= setup.scene->origin;
    setup.sdf = std::move(*sdf);
    setup.files.emplace_back(options.sdf);
    return {};
}

Result<std::unique_ptr<MovableTracer>> openProbeTracer(const Backend& backend, const LoadedSetup& setup,
                                                       const ScenePose& pose) {
    if (!setup.sdf) return std::unique_ptr<MovableTracer>();
    auto tracer = backend.openSdf(*setup.sdf, *setup.scene, pose);
    if (!tracer) return fail(tracer.error().code, fmt::format("--sdf: {}", tracer.error().message));
    return tracer;
}

std::size_t sdfBytes(const SdfScene& sdf) {
    constexpr std::size_t kPrimitiveBytes = 48;  // docs/sdf.md
    return kPrimitiveBytes * sdf.primitives.size();
}

}  // namespace probegi::tool
