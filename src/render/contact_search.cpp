#include <cmath>
#include <glm/geometric.hpp>

#include "kernels/screen/contact_way.h"
#include "render/frame_pass.h"

namespace probegi {

namespace {

// One side of a slice: `step` pixels across and down for each pixel along it.
void searchSide(Frame& frame, int x, int y, const ScreenSample& from, const kernels::ContactSlice& slice, float sign,
                glm::vec2 across, float phase, float widest, float reach, bool limited, kernels::ContactSums& sums) {
    kernels::ContactSide side = kernels::contactSide(slice, sign);
    for (int step = 0; step < kernels::kContactSteps; ++step) {
        const glm::vec2 off = sign * kernels::contactStep(step, phase, widest) * across;
        const int i = x + int(std::floor(off.x + 0.5f)), j = y + int(std::floor(off.y + 0.5f));
        if (!frame.contact->contains(i, j)) break;
        const ScreenSample& tap = frame.at(i, j, frame.firstPlane());
        if (tap.kind == kSampleSky) continue;
        const glm::vec3 offset = tap.position - from.position;
        const glm::vec3 radiance = kernels::contactRadiance(tap.direct, tap.albedo, tap.irradiance);
        const float share = limited ? kernels::contactShare(radiance, from.irradiance) : 1.0f;
        const float arc = kernels::raiseHorizon(side, slice, from.geometricNormal, offset, reach, share);
        if (arc > 0.0f)
            kernels::addContact(sums, arc * slice.weight, offset, tap.geometricNormal, radiance, tap.albedo);
    }
}

kernels::ContactFound searchAround(const PictureTask& task, Frame& frame, int x, int y, const ScreenSample& from) {
    kernels::ContactSums sums = kernels::noContact();
    const glm::vec2 random = kernels::contactPattern(x, y, task.contactRound + frame.firstPlane());
    for (int i = 0; i < kernels::kContactSlices; ++i) {
        const kernels::ContactWay way = kernels::contactWay(task.camera, from.viewDirection, i, random.x);
        const float widest = kernels::contactWidest(way, from.distance, task.contactReach);
        const kernels::ContactSlice slice =
            kernels::contactSlice(-from.viewDirection, way.tangent, from.shadingNormal, from.geometricNormal);
        sums.whole += kernels::contactWhole(slice);
        for (const float sign : {-1.0f, 1.0f})
            searchSide(frame, x, y, from, slice, sign, way.across, random.y, widest, task.contactReach,
                       task.field != nullptr, sums);
    }
    return kernels::contactFound(sums, from.irradiance);
}

}  // namespace

Result<void> searchContact(PictureTask& task, const PixelRect& part, Frame& frame) {
    forEachPixel(part, [&](int x, int y) {
        const ScreenSample& from = frame.at(x, y, frame.firstPlane());
        frame.contact->found(x, y) = from.kind == kSampleSurface
                                         ? searchAround(task, frame, x, y, from)
                                         : kernels::contactFound(kernels::noContact(), from.irradiance);
    });
    return {};
}

}  // namespace probegi
