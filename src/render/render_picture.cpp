#include <new>

#include "geometry/lighting.h"
#include "geometry/picture_desc.h"
#include "render/picture_runner.h"

namespace probegi {

PictureTask::PictureTask(const PictureInputs& inputs)
    : PictureInputs(inputs),
      camera(kernels::makePinhole(desc.camera.position, desc.camera.forward, desc.camera.up, desc.camera.yfov,
                                  desc.width, desc.height)),
      sceneMagnitude(probegi::sceneMagnitude(tracer.bounds())),
      layers(emptyPicture(desc.width, desc.height)) {
    if (hasGlossy(desc)) layers.glossy = HdrImage(desc.width, desc.height);
    // Lets the tracer prepare for filtering here, on all threads. If it fails, so will the first rays.
    static_cast<void>(tracer.filteredSurfaces({}, {}, kernels::pinholeSpread(camera, desc.samplesPerAxis), {}));
}

std::vector<FramePass> picturePasses(const PictureDesc& desc) {
    std::vector<FramePass> passes;
    for (const PassInfo& info : kPicturePasses)
        if (!info.glossy || hasGlossy(desc)) passes.push_back({passFunction(info.pass), info.time, info.neighbours});
    return passes;
}

Result<RenderedPicture> renderPicture(const Context& context, const Tracer& tracer, const Lighting& lighting,
                                      const Field* field, const PictureDesc& desc) {
    if (const auto checked = validatePictureDesc(desc); !checked) return checked.error();
    try {
        return runPicture(context, {tracer, lighting, field, desc}, picturePasses(desc));
    } catch (const std::bad_alloc&) {
        return pictureDoesNotFit(desc);
    }
}

}  // namespace probegi
