#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "probegi/render.h"

namespace probegi {

/// What is done with the samples (ScreenSample) of a picture. src/render and src/vulkan/picture have each pass on their
/// backend.
enum class PicturePass : std::uint8_t {
    primary,  ///< what each sample shows, its own emission, or the sky
    direct,   ///< punctual lights with shadows
    query,    ///< the field
    // PictureDesc::glossy. A block is 2 x 2 pixels.
    glossyTrace,   ///< a ray for each block, and what it hits
    glossyDirect,  ///< punctual lights there
    glossyQuery,   ///< the field there
    glossyField,   ///< the field in mirror directions, there and where rough surfaces need it
    glossyLight,   ///< light of each ray, and how far it is to be blurred
    glossyBlur,    ///< from neighbours
    glossySpread,  ///< from blocks farther away
    glossyShade,   ///< from the blocks to the samples
    // PictureDesc::contact.
    contactSearch,   ///< what near surfaces send and block
    contactBlur,     ///< with that of neighbours
    contactHistory,  ///< and of the picture before
    contactShade,    ///< from there to the samples
    accumulate,      ///< samples are added to the layers of their pixels; the last of a pixel makes means of them
};

struct PassInfo {
    PicturePass pass;
    const char* name;            ///< of its timestamps
    double PictureTimes::*time;  ///< where its time counts; null: in the total only
    /// Reads other pixels' samples: a screen pass. What it reads of them it must not write, for they may be at work.
    bool neighbours;
    bool glossy = false;   ///< only with PictureDesc::glossy
    bool contact = false;  ///< only with PictureDesc::contact
};

/// The passes in their order, on every backend.
///
/// A plane is one sample of every pixel, row-major. If any pass has neighbours, planes go through the passes one after
/// the other, each pass with all of the frame behind it. A frame is the whole picture up to kFramePixels, or else a
/// band of rows, so that memory stays bounded; neighbours are those within the band.
///
/// If none has, nothing needs a frame: small parts of the picture take all their planes from pass to pass together,
/// which saves the memory and its traffic, and rays of a pixel are traced side by side (measured on the CPU: 15 to 18 %
/// of a picture's time).
inline constexpr std::array kPicturePasses{
    PassInfo{PicturePass::primary, "primary", &PictureTimes::primary, false},
    PassInfo{PicturePass::direct, "direct", &PictureTimes::direct, false},
    PassInfo{PicturePass::query, "query", &PictureTimes::query, false},
    PassInfo{PicturePass::glossyTrace, "glossy trace", &PictureTimes::glossy, true, true},
    PassInfo{PicturePass::glossyDirect, "glossy direct", &PictureTimes::glossy, false, true},
    PassInfo{PicturePass::glossyQuery, "glossy query", &PictureTimes::glossy, false, true},
    PassInfo{PicturePass::glossyField, "glossy field", &PictureTimes::glossy, false, true},
    PassInfo{PicturePass::glossyLight, "glossy light", &PictureTimes::glossy, true, true},
    PassInfo{PicturePass::glossyBlur, "glossy blur", &PictureTimes::glossy, true, true},
    PassInfo{PicturePass::glossySpread, "glossy spread", &PictureTimes::glossy, true, true},
    PassInfo{PicturePass::glossyShade, "glossy shade", &PictureTimes::glossy, true, true},
    PassInfo{PicturePass::contactSearch, "contact search", &PictureTimes::contact, true, false, true},
    PassInfo{PicturePass::contactBlur, "contact blur", &PictureTimes::contact, true, false, true},
    PassInfo{PicturePass::contactHistory, "contact history", &PictureTimes::contact, true, false, true},
    PassInfo{PicturePass::contactShade, "contact shade", &PictureTimes::contact, false, false, true},
    // Screen passes go here.
    PassInfo{PicturePass::accumulate, "accumulate", nullptr, false},
};

/// 3840 x 2160 fit, 839 MB of samples, 386 MB more with glossy light, and 369 MB more with contact light.
inline constexpr std::size_t kFramePixels = std::size_t(1) << 23;

/// Rows of a frame of at most `framePixels`, one at least. Bands have so many, but for the last.
inline int frameRows(const PictureDesc& desc, std::size_t framePixels) {
    return int(std::clamp<std::size_t>(framePixels / std::size_t(desc.width), 1, std::size_t(desc.height)));
}

/// Whether a picture has the passes of PictureDesc::glossy.
inline bool hasGlossy(const PictureDesc& desc) {
    return desc.glossy != Glossy::off && !desc.diffuseOnly;
}

/// Whether a picture goes on from PictureDesc::contactHistory.
inline bool keepsContact(const PictureDesc& desc) {
    return desc.contact && desc.contactHistory && std::size_t(desc.width) * std::size_t(desc.height) <= kFramePixels;
}

/// Whether a picture has a pass.
inline bool hasPass(const PassInfo& info, const PictureDesc& desc) {
    if (info.pass == PicturePass::contactHistory && !keepsContact(desc)) return false;
    return (!info.glossy || hasGlossy(desc)) && (!info.contact || desc.contact);
}

/// Planes of a picture: sub-samples of a pixel.
inline int planeCount(const PictureDesc& desc) {
    return desc.samplesPerAxis * desc.samplesPerAxis;
}

}  // namespace probegi
