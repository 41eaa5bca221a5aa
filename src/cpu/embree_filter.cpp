#include "cpu/embree_filter.h"

#include "cpu/embree_scene.h"
#include "geometry/surface_shader.h"

namespace probegi {

namespace {

bool transparent(const EmbreeFilterData& data, unsigned primitive, glm::vec2 barycentric) {
    const SurfaceTriangle& triangle = data.mesh->triangles[primitive];
    const SurfaceMaterial& material = data.materials[triangle.material];
    const TextureSampler& texture = material.baseColorTexture;
    const glm::vec2 uv = interpolateUv(*data.mesh, triangle, barycentric, texture.texCoord());
    return texture.alpha(uv) < material.textureAlphaCutoff;
}

}  // namespace

void rejectTransparent(const RTCFilterFunctionNArguments* args) {
    const auto& data = *static_cast<const EmbreeFilterData*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const glm::vec2 barycentric(RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
        if (transparent(data, RTCHitN_primID(args->hit, args->N, i), barycentric)) args->valid[i] = 0;
    }
}

}  // namespace probegi
