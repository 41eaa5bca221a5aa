#include <new>

#include "field/contact_reach.h"
#include "geometry/lighting.h"
#include "geometry/picture_desc.h"
#include "render/picture_runner.h"

namespace probegi {

PictureTask::PictureTask(const PictureInputs& inputs)
    : PictureInputs(inputs),
      camera(kernels::makePinhole(desc.camera.position, desc.camera.forward, desc.camera.up, desc.camera.yfov,
                                  desc.width, desc.height)),
      sceneMagnitude(probegi::sceneMagnitude(tracer.bounds())),
      contactReach(probegi::contactReach(desc, field, tracer.bounds())),
      layers(emptyPicture(desc.width, desc.height)) {
    if (hasGlossy(desc)) layers.glossy = HdrImage(desc.width, desc.height);
    if (desc.contact) layers.contact = layers.openness = HdrImage(desc.width, desc.height);
    if (keepsContact(desc)) {
        const ContactHistory::Impl& history = desc.contactHistory->impl();
        if (history.fits(desc) && !history.records.empty()) past = &history;
        contactRound = history.pictures * planeCount(desc);
        records.resize(std::size_t(desc.width) * std::size_t(desc.height));
    }
    // Lets the tracer prepare for filtering here, on all threads. If it fails, so will the first rays.
    static_cast<void>(tracer.filteredSurfaces({}, {}, kernels::pinholeSpread(camera, desc.samplesPerAxis), {}));
}

void PictureTask::remember() {
    if (records.empty()) return;
    ContactHistory::Impl& history = desc.contactHistory->impl();
    history.keep(desc, camera);
    history.records = std::move(records);
    history.store.reset();
}

std::vector<FramePass> picturePasses(const PictureDesc& desc) {
    std::vector<FramePass> passes;
    for (const PassInfo& info : kPicturePasses)
        if (hasPass(info, desc)) passes.push_back({passFunction(info.pass), info.time, info.neighbours});
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
