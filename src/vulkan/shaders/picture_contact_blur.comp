// Contact light and that of its neighbours.
#include "picture_contact.glsl"

vec4 blurredAt(uint index, ContactFounds founds) {
    const int x = int(index) % push.width;
    const int y = int(index) / push.width;
    const GlossyGuide centre = guideAt(index);
    ContactMean mean = contactMean(founds.at[index].difference, contactTap(0, 0));
    for (int j = -kContactTaps; j <= kContactTaps; ++j)
        for (int i = -kContactTaps; i <= kContactTaps; ++i) {
            if ((i == 0 && j == 0) || !inFrame(x + i, y + j)) continue;
            const uint tap = uint((y + j) * push.width + x + i);
            if (Samples(push.samples).at[tap].kind != kSampleSurface) continue;
            const float weight =
                guideWeight(centre, guideAt(tap), sqrt(float(i * i + j * j)), pinholeSpread(push.camera, 1));
            addContactTap(mean, founds.at[tap].difference, weight * contactTap(i, j));
        }
    return contactMeanOf(mean);
}

void main() {
    const uint index = globalIndex();
    if (index >= push.sampleCount) return;
    const ContactBlock block = contactBlock();
    const bool lit = Samples(push.samples).at[index].kind == kSampleSurface;
    Vec4s(block.blurred).at[index] = lit ? blurredAt(index, ContactFounds(block.found)) : vec4(0.0);
}
