#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <new>

#include "core/progress.h"
#include "core/sentence.h"
#include "probegi/sdf_fit.h"
#include "sdf/fit/fit_frames.h"
#include "sdf/fit/fit_looks.h"
#include "sdf/fit/fit_search.h"
#include "sdf/fit/sdf_accuracy.h"
#include "sdf/placed_primitives.h"

namespace probegi {

namespace {

constexpr int kMostFrames = 4;
constexpr float kUsualError = 0.003f;       ///< of the scene's diagonal: beyond it, errors count ever less
constexpr std::size_t kTestRays = 200'000;  ///< that the accuracy is measured by
constexpr float kBeside = 4;                ///< usual errors within which a primitive has its colour from the scene

Result<void> check(const SdfFitDesc& desc) {
    const auto outside = [](const char* name, int value, int least, int most) -> Result<void> {
        if (value >= least && value <= most) return {};
        return fail(ErrorCode::invalidArgument, sentence(name, " is ", value, "; it must be ", least, " to ", most));
    };
    if (auto good = outside("maxPrimitives", desc.maxPrimitives, 1, 1024); !good) return good;
    if (auto good = outside("rays", desc.rays, 1000, 16'000'000); !good) return good;
    return outside("rounds", desc.rounds, 0, 10'000);
}

SdfScene pinnedOf(const SdfScene* keep) {
    SdfScene pinned;
    if (keep)
        std::copy_if(keep->primitives.begin(), keep->primitives.end(), std::back_inserter(pinned.primitives),
                     [](const SdfPrimitive& p) { return p.pinned; });
    return pinned;
}

SdfPrimitive primitiveOf(const FitBox& box, const glm::mat3& frame) {
    SdfPrimitive p;
    p.centre = frame * (0.5f * (box.lower + box.upper));
    p.halfSize = 0.5f * (box.upper - box.lower);
    p.rotation = glm::normalize(glm::quat_cast(frame));
    return p;
}

/// Where the rays end among the pinned primitives.
std::vector<float> endsAmong(std::span<const kernels::SdfSolid> solids, std::span<const FitRay> rays) {
    std::vector<float> ends;
    if (solids.empty()) return ends;
    int number = -1;
    for (const FitRay& ray : rays) ends.push_back(entersUnion(solids, ray, number));
    return ends;
}

Result<SdfFit> fitted(const Context& context, const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                      const SdfFitDesc& desc) {
    SdfFit out;
    out.sdf = pinnedOf(desc.keep);
    const auto pinned = PlacedPrimitives::create(out.sdf, scene, pose);
    if (!pinned) return pinned.error();
    const std::size_t fixed = out.sdf.primitives.size();
    if (fixed > std::size_t(desc.maxPrimitives))
        return fail(ErrorCode::invalidArgument, sentence(fixed, " primitives are pinned, but there may be ",
                                                         desc.maxPrimitives, "; allow more or unpin some"));
    Progress progress(context, "fitting primitives", 1);
    const auto walked = walkThrough(context, tracer, pose.cameras, std::size_t(desc.rays), desc.seed);
    if (!walked) return walked.error();
    if (walked->rays.empty())
        return fail(ErrorCode::invalidArgument,
                    "the scene has no surface that is seen from its front, from any place in the air; check the "
                    "winding of its meshes");
    const float error = kUsualError * glm::length(tracer.bounds().size());
    const std::vector<glm::mat3> frames = findFrames(walked->surfaces, kMostFrames);
    const std::vector<float> ends = endsAmong(pinned->solids(), walked->rays);
    FitSearch search;
    search.rays = walked->rays;
    search.surfaces = walked->surfaces;
    search.ends = ends;
    search.frames = frames;
    search.cost.usual = error;
    search.most = desc.maxPrimitives - int(fixed);
    search.rounds = desc.rounds;
    search.seed = desc.seed;
    for (const FitBox& box : findBoxes(context, search, progress))
        out.sdf.primitives.push_back(primitiveOf(box, frames[std::size_t(box.frame)]));
    if (!progress.set(0.95)) return fail(ErrorCode::cancelled, "the fit was cancelled");

    std::vector<kernels::SdfSolid> solids;
    if (auto placed = PlacedPrimitives::create(out.sdf, scene, pose); placed) solids = placed->solids();
    giveLooks(out.sdf.primitives, solids, fixed, *walked, kBeside * error, scene);
    auto accuracy = measureSdf(context, scene, pose, tracer, out.sdf, int(kTestRays), desc.seed + 1);
    if (!accuracy) return accuracy.error();
    out.accuracy = *accuracy;
    progress.set(1);
    return out;
}

}  // namespace

Result<SdfFit> fitSdf(const Context& context, const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                      const SdfFitDesc& desc) {
    if (auto good = check(desc); !good) return good.error();
    try {
        return fitted(context, scene, pose, tracer, desc);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::outOfMemory, "not enough memory to fit primitives; use fewer rays");
    }
}

}  // namespace probegi
