// The types of include/probegi/tracer.h in GLSL, with the same names.
#ifndef PROBEGI_VULKAN_TYPES_GLSL
#define PROBEGI_VULKAN_TYPES_GLSL

// A half-line. Hits closer than `near` or farther than `far` do not count.
struct Ray {
    vec3 origin;
    float near;      // metres
    vec3 direction;  // unit
    float far;       // metres
};

// The closest surface along a Ray. `primitive < 0`: nothing was hit.
struct Hit {
    float distance;    // metres along the ray; kNoHitDistance: nothing
    int primitive;     // triangle of the mesh
    int geometry;      // kGeometryOpaque or kGeometryMasked
    int instance;      // placement, as in GpuInstance's array; -1: the world
    vec2 barycentric;  // weights of the second and third corner
};

const float kNoHitDistance = 1e30;
const int kGeometryOpaque = 0;
const int kGeometryMasked = 1;

// What a hit looks like to light: geometry and material resolved, textures sampled. Normals face the ray's origin.
struct Surface {
    vec3 position;
    vec3 geometricNormal;  // unit, on the side the ray came from
    vec3 shadingNormal;    // unit, interpolated and normal-mapped, on the same side as the ray's origin
    vec3 albedo;           // base colour, 0..1
    vec3 emission;         // radiance towards the ray's origin, W sr^-1 m^-2 (0 on a backface)
    float metallic;
    float roughness;
    int material;   // index into Scene::materials
    bool back;      // the ray met the back, by winding, whatever the material
    bool backface;  // the back of a single-sided material: solid wall
};

#endif
