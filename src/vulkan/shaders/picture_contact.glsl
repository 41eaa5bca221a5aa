// What the passes of PictureDesc::contact keep, and the frame's neighbours.
#ifndef PROBEGI_PICTURE_CONTACT_GLSL
#define PROBEGI_PICTURE_CONTACT_GLSL

#include "picture.glsl"

#include "kernels/screen/contact_history.h"
#include "kernels/screen/contact_light.h"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ContactBlocks {
    ContactBlock at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ContactFounds {
    ContactFound at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ContactRecords {
    ContactRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Vec4s {
    vec4 at[];
};

ContactBlock contactBlock() {
    return ContactBlocks(push.contact).at[0];
}

bool inFrame(int x, int y) {
    return x >= 0 && y >= 0 && x < push.width && y < push.rows;
}

GlossyGuide guideAt(uint index) {
    const ScreenSample s = Samples(push.samples).at[index];
    return contactGuide(s.position, s.geometricNormal, s.distance);
}

#endif
