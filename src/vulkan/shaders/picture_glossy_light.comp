// The light of each glossy ray, from what it hit.
#include "picture_glossy.glsl"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

void main() {
    const uint index = globalIndex();
    if (index >= glossyCount(push)) return;
    const ScreenSample hit = glossyHits(push).at[index];
    const vec3 mirrored = glossySamples(push).at[index].radiance;
    glossySamples(push).at[index].radiance =
        hitRadiance(materialOf(hit), -dot(hit.viewDirection, hit.shadingNormal), hit.direct, hit.irradiance, mirrored);
}
