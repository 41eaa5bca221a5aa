#include "kernels/screen/contact_blur.h"

#include <glm/geometric.hpp>

#include "render/frame_pass.h"

namespace probegi {

namespace {

kernels::GlossyGuide guideOf(const ScreenSample& sample) {
    return kernels::contactGuide(sample.position, sample.geometricNormal, sample.distance);
}

glm::vec4 blurred(Frame& frame, int x, int y, float pixelAngle) {
    const kernels::GlossyGuide centre = guideOf(frame.at(x, y, frame.firstPlane()));
    kernels::ContactMean mean = kernels::contactMean(frame.contact->found(x, y).difference, kernels::contactTap(0, 0));
    for (int j = -kernels::kContactTaps; j <= kernels::kContactTaps; ++j)
        for (int i = -kernels::kContactTaps; i <= kernels::kContactTaps; ++i) {
            if ((i == 0 && j == 0) || !frame.contact->contains(x + i, y + j)) continue;
            const ScreenSample& tap = frame.at(x + i, y + j, frame.firstPlane());
            if (tap.kind != kSampleSurface) continue;
            const float weight =
                kernels::guideWeight(centre, guideOf(tap), std::sqrt(float(i * i + j * j)), pixelAngle);
            kernels::addContactTap(mean, frame.contact->found(x + i, y + j).difference,
                                   weight * kernels::contactTap(i, j));
        }
    return kernels::contactMeanOf(mean);
}

}  // namespace

Result<void> blurContact(PictureTask& task, const PixelRect& part, Frame& frame) {
    const float pixelAngle = kernels::pinholeSpread(task.camera, 1);
    forEachPixel(part, [&](int x, int y) {
        frame.contact->blurred(x, y) = frame.at(x, y, frame.firstPlane()).kind == kSampleSurface
                                           ? blurred(frame, x, y, pixelAngle)
                                           : glm::vec4(0.0f);
    });
    return {};
}

Result<void> shadeContact(PictureTask&, const PixelRect& part, Frame& frame) {
    forEachPixel(part, [&](int x, int y) {
        ScreenSample& sample = frame.at(x, y, frame.firstPlane());
        if (sample.kind != kSampleSurface) return;
        sample.irradiance = kernels::withContact(sample.irradiance, frame.contact->kept(x, y));
    });
    return {};
}

}  // namespace probegi
