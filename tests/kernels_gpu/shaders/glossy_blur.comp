#include "lane.h"

#include "kernels/screen/glossy_blur.h"

GlossyGuide takeGuide(INOUT(Lane) lane, vec3 normal) {
    GlossyGuide guide;
    guide.position = takeVector(lane, 0.0f, 0.01f);
    guide.geometricNormal = normal;
    guide.shadingNormal = normalize(normal + takeVector(lane, -0.03f, 0.03f));
    guide.roughness = takeBetween(lane, 0.3f, 0.4f);
    guide.distance = takeBetween(lane, 1.0f, 5.0f);
    return guide;
}

void evaluate(INOUT(Lane) lane) {
    const vec3 normal = takeDirection(lane);
    const GlossyGuide centre = takeGuide(lane, normal);
    const GlossyGuide tap = takeGuide(lane, normal);
    give(lane, guideWeight(centre, tap, takeBetween(lane, 0.0f, 20.0f), 1e-2f), 1e-4f);
    const float far = takeBetween(lane, 0.0f, 10.0f);
    const float radius = glossyBlurRadius(takeUnit(lane), 0.1f * far, 2e-3f);
    give(lane, radius, 1e-5f);
    give(lane, glossyStep(radius), 1e-5f);
    give(lane, glossyWideShare(radius), 1e-4f);
    const float step = takeBetween(lane, 1.0f, 5.0f);
    give(lane, float(glossyOffset(takeIndex(lane, 7) - 3, floor(step))), 0.0f);
    give(lane, glossyFalloff(far, step), 1e-5f);
    const float alongX = takeBetween(lane, -3.0f, 3.0f);
    give(lane, glossyTent(alongX, takeBetween(lane, -3.0f, 3.0f)), 1e-6f);
    GlossyMean mean = glossyMean(normal, 0.25f);
    const vec3 other = takeVector(lane, 0.0f, 10.0f);
    addTap(mean, other, takeUnit(lane));
    giveVec3(lane, meanOf(mean), 1e-5f);
}
