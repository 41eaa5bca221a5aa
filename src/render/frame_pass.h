#pragma once

#include <vector>

#include "geometry/contact_store.h"
#include "geometry/picture_passes.h"
#include "kernels/screen/pinhole.h"
#include "render/contact_frame.h"
#include "render/glossy_frame.h"

namespace probegi {

/// What a picture is of.
struct PictureInputs {
    const Tracer& tracer;
    const Lighting& lighting;
    const Field* field;  // may be null
    const PictureDesc& desc;
};

/// One picture in the making: what passes read, and the layers that the last one fills.
struct PictureTask : PictureInputs {
    explicit PictureTask(const PictureInputs& inputs);

    /// Once the picture is complete: what the next one must know of it.
    void remember();

    kernels::PinholeCamera camera;
    float sceneMagnitude;                         // sceneMagnitude(tracer.bounds())
    float contactReach;                           // metres
    int contactRound = 0;                         // of the first plane's noise
    const ContactHistory::Impl* past = nullptr;   // null: none, or of another size
    std::vector<kernels::ContactRecord> records;  // row-major; empty: nobody asks
    Picture layers;
};

/// Does one pass for a part of a frame. Threads work on different parts at a time. Errors: those of the tracer and of
/// Field::irradiance.
using PassFunction = Result<void> (*)(PictureTask& task, const PixelRect& part, Frame& frame);

/// A pass on the CPU; members as in PassInfo.
struct FramePass {
    PassFunction run;
    double PictureTimes::*time = nullptr;
    bool neighbours = false;
};

// Each in a file of its own.
Result<void> castPrimary(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> shadeDirect(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> queryField(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> traceGlossy(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> lightGlossyHits(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> queryGlossyHits(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> queryReflections(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> collectGlossy(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> blurGlossy(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> spreadGlossy(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> shadeGlossy(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> searchContact(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> blurContact(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> keepContact(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> shadeContact(PictureTask& task, const PixelRect& part, Frame& frame);
Result<void> accumulateLayers(PictureTask& task, const PixelRect& part, Frame& frame);

constexpr PassFunction passFunction(PicturePass pass) {
    switch (pass) {
        case PicturePass::primary:
            return castPrimary;
        case PicturePass::direct:
            return shadeDirect;
        case PicturePass::query:
            return queryField;
        case PicturePass::glossyTrace:
            return traceGlossy;
        case PicturePass::glossyDirect:
            return lightGlossyHits;
        case PicturePass::glossyQuery:
            return queryGlossyHits;
        case PicturePass::glossyField:
            return queryReflections;
        case PicturePass::glossyLight:
            return collectGlossy;
        case PicturePass::glossyBlur:
            return blurGlossy;
        case PicturePass::glossySpread:
            return spreadGlossy;
        case PicturePass::glossyShade:
            return shadeGlossy;
        case PicturePass::contactSearch:
            return searchContact;
        case PicturePass::contactBlur:
            return blurContact;
        case PicturePass::contactHistory:
            return keepContact;
        case PicturePass::contactShade:
            return shadeContact;
        case PicturePass::accumulate:
            return accumulateLayers;
    }
    return nullptr;
}

/// kPicturePasses on the CPU, those that the picture has.
std::vector<FramePass> picturePasses(const PictureDesc& desc = {});

/// Calls visit(x, y) for the pixels of a part, row by row.
template <class Visit>
void forEachPixel(const PixelRect& part, const Visit& visit) {
    for (int y = part.y; y < part.y + part.height; ++y)
        for (int x = part.x; x < part.x + part.width; ++x) visit(x, y);
}

/// Calls visit(sample) for the samples of a part, pixel by pixel.
template <class Visit>
void forEachSample(const PixelRect& part, Frame& frame, const Visit& visit) {
    forEachPixel(part, [&](int x, int y) {
        for (int plane = frame.firstPlane(); plane < frame.endPlane(); ++plane) visit(frame.at(x, y, plane));
    });
}

}  // namespace probegi
