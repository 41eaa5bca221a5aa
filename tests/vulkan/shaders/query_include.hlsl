// The same as query_include.comp in HLSL, with the include that SPIRV-Cross translated.
#define PROBEGI_SPACE space1
#define PROBEGI_BINDING_0 3
#define PROBEGI_BINDING_1 4
#define PROBEGI_BINDING_2 5
#define PROBEGI_BINDING_3 6
#include "probegi/query.hlsl"

ByteAddressBuffer questions : register(t0, space0);
RWByteAddressBuffer answers : register(u1, space0);
[[vk::push_constant]] cbuffer Push {
    uint count;
};

[numthreads(32, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
    const uint i = id.x;
    if (i >= count) return;
    const float3 position = asfloat(questions.Load3(36 * i)), normal = asfloat(questions.Load3(36 * i + 12)),
                 toViewer = asfloat(questions.Load3(36 * i + 24));
    float3 answer = probegiIrradiance(position, normal, toViewer);
    if (all(normal == 0)) answer = float3(probegiCoverage(position), probegiVolumeAt(position), 0);
    if (toViewer.x >= 2) answer = probegiRayDirection(int(toViewer.x) - 2);
    if (toViewer.y >= 2) answer = probegiFixedRayDirection(int(toViewer.y) - 2);
    answers.Store3(12 * i, asuint(answer));
}
