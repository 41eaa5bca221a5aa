// What the passes of PictureDesc::glossy keep in the buffer PicturePush::glossy: what each block's ray hit, the blocks,
// and the light of each pixel's glossy lobe.
#ifndef PROBEGI_PICTURE_GLOSSY_GLSL
#define PROBEGI_PICTURE_GLOSSY_GLSL

#include "kernels/abi/gpu_scene.h"
#include "kernels/screen/glossy_blur.h"
#include "kernels/screen/glossy_ray.h"
#include "picture.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer GlossySamples {
    GlossySample at[];
};

// Of a frame, in blocks of 2 x 2 pixels.
ivec2 glossySize(PicturePush push) {
    return ivec2(glossyBlocks(push.width), glossyBlocks(push.rows));
}

uint glossyCount(PicturePush push) {
    const ivec2 size = glossySize(push);
    return uint(size.x) * uint(size.y);
}

Samples glossyHits(PicturePush push) {
    return Samples(push.glossy);
}

GlossySamples glossySamples(PicturePush push) {
    return GlossySamples(addAddress(push.glossy, uvec2(glossyCount(push) * 100u, 0u)));
}

Vec3s glossyLobes(PicturePush push) {
    return Vec3s(addAddress(push.glossy, uvec2(glossyCount(push) * 136u, 0u)));
}

// The material of a sample, as pictures with all lobes have it.
Bsdf materialOf(ScreenSample s) {
    return makeBsdf(s.albedo, s.metallic, s.roughness, false);
}

GlossyGuide guideOf(ScreenSample s) {
    return GlossyGuide(s.position, s.geometricNormal, s.shadingNormal, s.roughness, s.distance);
}

// E / pi around a surface's mirror direction needs the field there. The normal takes the viewer's place: nobody looks
// along the direction.
vec3 mirrorOf(ScreenSample s) {
    return mirrorDirection(s.shadingNormal, s.geometricNormal, s.viewDirection);
}

#endif
