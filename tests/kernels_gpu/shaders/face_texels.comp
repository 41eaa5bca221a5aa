#include "lane.h"

#include "some_solid.h"

#include "kernels/sdf/face_texels.h"

// Texels jump where faces and texels meet; what is read between them does not but at edges, from which points keep off.
void evaluate(INOUT(Lane) lane) {
    SdfSolid solid = takeSolid(lane);
    const vec3 colour = takeVector(lane, -0.2f, 1.2f);
    give(lane, float(sdfPackChannel(colour.x)), 1.0f);
    giveVec3(lane, sdfUnpackColour(sdfPackColour(colour)), 0.01f);

    const float u = takeBetween(lane, -0.93f, 0.91f);
    const float v = takeBetween(lane, -0.92f, 0.94f);
    give(lane, sdfAlongFace(u), 1e-5f);
    const int axis = takeIndex(lane, 3);
    const float side = takeBetween(lane, 0.0f, 1.0f) < 0.5f ? -1.0f : 1.0f;
    const vec3 place = axis == 0 ? vec3(side, u, v) : (axis == 1 ? vec3(v, side, u) : vec3(u, v, side));
    // Slabs, so that a face's points are nearest to it.
    solid.halfSize =
        axis == 0 ? vec3(0.05f, 0.9f, 0.7f) : (axis == 1 ? vec3(0.9f, 0.05f, 0.7f) : vec3(0.7f, 0.9f, 0.05f));
    const SdfFacePoint local = sdfFacePoint(solid.halfSize, place * solid.halfSize);
    const SdfFacePoint world = sdfFacePointAt(solid, solid.centre + sdfToWorld(solid, place * solid.halfSize));
    give(lane, float(local.first / 36), 0.0f);
    give(lane, float(world.first / 36), 0.0f);
    give(lane, float(local.first % 6) + local.u, 1e-4f);
    give(lane, float(world.first / 6 % 6) + world.v, 1e-4f);
    const uint base = uint(takeIndex(lane, 256));
    giveVec3(lane, sdfFaceColour(local, base, base * 3u, 0xff00ffu, 0x102030u), 1e-3f);
}
