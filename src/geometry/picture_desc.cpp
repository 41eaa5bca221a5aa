#include "geometry/picture_desc.h"

#include "core/sentence.h"

namespace probegi {

namespace {
constexpr int kMaxSide = 16384;
constexpr float kMostReach = 4;
}  // namespace

Result<void> validatePictureDesc(const PictureDesc& desc) {
    if (desc.width < 1 || desc.width > kMaxSide || desc.height < 1 || desc.height > kMaxSide)
        return fail(ErrorCode::invalidArgument,
                    sentence("a picture of ", desc.width, "x", desc.height,
                             " pixels is not supported; each side must be 1 to ", kMaxSide));
    if (desc.samplesPerAxis < 1 || desc.samplesPerAxis > 8)
        return fail(ErrorCode::invalidArgument,
                    sentence("samplesPerAxis is ", desc.samplesPerAxis, "; it must be 1 to 8"));
    if (desc.glossy != Glossy::off && desc.glossy != Glossy::first && desc.glossy != Glossy::field)
        return fail(ErrorCode::invalidArgument, "glossy is none of the values of probegi::Glossy");
    if (!(desc.contactReach > 0) || desc.contactReach > kMostReach)
        return fail(ErrorCode::invalidArgument, sentence("contactReach is ", desc.contactReach,
                                                         "; it must be more than 0 and at most ", kMostReach));
    return {};
}

Picture emptyPicture(int width, int height) {
    const auto layer = [=] { return HdrImage(width, height); };
    return {layer(), layer(), layer(), layer(), layer(), layer(), layer(), {}};
}

Error pictureDoesNotFit(const PictureDesc& desc) {
    return {ErrorCode::outOfMemory, sentence("a picture of ", desc.width, "x", desc.height,
                                             " pixels does not fit into memory; choose a smaller size")};
}

}  // namespace probegi
