#include <vector>

#include "render/frame_pass.h"

namespace probegi {

namespace {

struct Scratch {
    std::vector<ScreenSample*> lit;
    std::vector<FieldQuery> queries;
    std::vector<glm::vec3> irradiance;
};

}  // namespace

Result<void> queryField(PictureTask& task, const PixelRect& part, Frame& frame) {
    if (!task.field) return {};
    thread_local Scratch scratch;
    // No structured binding: lambdas capture none with clang 14.
    auto& lit = scratch.lit;
    auto& queries = scratch.queries;
    auto& irradiance = scratch.irradiance;
    lit.clear();
    queries.clear();
    forEachSample(part, frame, [&](ScreenSample& sample) {
        // The back of a wall receives nothing.
        if (sample.kind != kSampleSurface) return;
        lit.push_back(&sample);
        queries.push_back({sample.position, sample.shadingNormal, -sample.viewDirection});
    });
    irradiance.resize(queries.size());
    if (auto asked = task.field->irradiance(queries, irradiance); !asked) return asked;
    for (std::size_t i = 0; i < lit.size(); ++i) lit[i]->irradiance = irradiance[i];
    return {};
}

}  // namespace probegi
