#include <vector>

#include "render/frame_pass.h"

namespace probegi {

namespace {

struct Scratch {
    std::vector<FieldQuery> queries;
    std::vector<glm::vec3*> results;
    std::vector<glm::vec3> irradiance;
};

// E around a surface's mirror direction. The normal takes the viewer's place: nobody looks along the direction.
void ask(const ScreenSample& sample, glm::vec3& result, Scratch& scratch) {
    scratch.queries.push_back(
        {sample.position, kernels::mirrorDirection(sample.shadingNormal, sample.geometricNormal, sample.viewDirection),
         sample.shadingNormal});
    scratch.results.push_back(&result);
}

}  // namespace

Result<void> lightGlossyHits(PictureTask& task, const PixelRect& part, Frame& frame) {
    return shadeDirect(task, frame.glossy->blocksOf(part), frame.glossy->hits);
}

Result<void> queryGlossyHits(PictureTask& task, const PixelRect& part, Frame& frame) {
    return queryField(task, frame.glossy->blocksOf(part), frame.glossy->hits);
}

Result<void> queryReflections(PictureTask& task, const PixelRect& part, Frame& frame) {
    if (!task.field) return {};
    thread_local Scratch scratch;
    scratch.queries.clear();
    scratch.results.clear();
    GlossyFrame& glossy = *frame.glossy;
    forEachPixel(part, [&](int x, int y) {
        const ScreenSample& sample = frame.at(x, y, frame.firstPlane());
        if (sample.kind == kSampleSurface && kernels::glossyRayShare(sample.roughness) < 1.0f)
            ask(sample, glossy.lobe(x, y), scratch);
    });
    if (task.desc.glossy == Glossy::field)
        forEachPixel(glossy.blocksOf(part), [&](int column, int row) {
            const ScreenSample& hit = glossy.hits.at(column, row, 0);
            if (hit.kind == kSampleSurface) ask(hit, glossy.sample(column, row).radiance, scratch);
        });
    scratch.irradiance.resize(scratch.queries.size());
    if (auto asked = task.field->irradiance(scratch.queries, scratch.irradiance); !asked) return asked;
    for (std::size_t i = 0; i < scratch.results.size(); ++i)
        *scratch.results[i] = kernels::radianceOfIrradiance(scratch.irradiance[i]);
    return {};
}

}  // namespace probegi
