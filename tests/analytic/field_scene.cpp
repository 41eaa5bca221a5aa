#include "analytic/field_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/random.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {

namespace {

VolumeDesc gridFor(const ScenePose& pose, const PlacementDesc& placement) {
    return *placeVolume(pose.bounds, placement);
}

FieldSetup withGrid(FieldSetup desc, const VolumeDesc& grid) {
    desc.volumes = {grid};
    return desc;
}

}  // namespace

FieldScene::FieldScene(std::string_view name, const BuiltinParams& params, const PlacementDesc& placement,
                       FieldSetup desc)
    : context(*Context::create()),
      scene(*makeBuiltinScene(name, params)),
      pose(poseAt(scene)),
      tracer(std::move(*makeEmbreeTracer(context, scene, pose))),
      lighting{pose.lights, scene.sky},
      field(*withGrid(desc, gridFor(pose, placement)).make(context)) {}

FieldScene::FieldScene(Scene ownScene, const VolumeDesc& grid, FieldSetup desc)
    : context(*Context::create()),
      scene(std::move(ownScene)),
      pose(poseAt(scene)),
      tracer(std::move(*makeEmbreeTracer(context, scene, pose))),
      lighting{pose.lights, scene.sky},
      field(*withGrid(desc, grid).make(context)) {}

void FieldScene::run(int frames) {
    for (int i = 0; i < frames; ++i) ASSERT_TRUE(field.update(*tracer, lighting));
}

std::vector<FieldQuery> FieldScene::surfaceQueries(int count, float mostBacks) const {
    std::vector<FieldQuery> queries;
    std::uint32_t state = 17;
    const auto random = [&] { return kernels::nextRandom(state); };
    const VolumeDesc& grid = field.desc().volumes[0];
    for (int attempt = 0; attempt < 100 * count && int(queries.size()) < count; ++attempt) {
        const float z = 2 * random() - 1, phi = 6.2831853f * random(), r = std::sqrt(1 - z * z);
        Ray ray;
        const int probe = int(random() * float(probeCount(grid)));
        if (probeBackfaceShare(field, probe) > mostBacks) continue;
        ray.origin = probePosition(grid, probe);
        ray.direction = {r * std::cos(phi), r * std::sin(phi), z};
        Hit hit;
        Surface surface;
        tracer->closestHits({&ray, 1}, {&hit, 1}).value();
        if (!hit.valid()) continue;
        tracer->surfaces({&ray, 1}, {&hit, 1}, {&surface, 1}).value();
        if (!surface.backface) queries.push_back({surface.position, surface.shadingNormal, -ray.direction});
    }
    EXPECT_EQ(int(queries.size()), count);
    return queries;
}

}  // namespace probegi::test
