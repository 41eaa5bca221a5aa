// The light in a closed scene does not depend on whether its materials are double-sided, and neither may the field.
#include <gtest/gtest.h>

#include "analytic/field_scene.h"
#include "probegi/measure.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi {
namespace {

using test::FieldSetup;

Scene withSides(std::string_view name, bool doubleSided) {
    Scene scene = *makeBuiltinScene(name);
    for (Material& material : scene.materials) material.doubleSided = doubleSided;
    return scene;
}

struct SidesDifference {
    double rms = 0;  ///< RMS difference at surface points, over the mean
    int solid = 0;   ///< probes in walls
};

// With the same probes and rays in both scenes.
SidesDifference measureSides(std::string_view name, const VolumeDesc& grid, int updates) {
    FieldSetup desc;
    desc.raysPerProbe = 64;
    test::FieldScene one(withSides(name, false), grid, desc), two(withSides(name, true), grid, desc);
    one.run(updates);
    two.run(updates);
    // Points in the open only. No light reaches the inside of intersecting leaves, but there the shortened distances of
    // single-sided backs (section 4.1) hide the dark probes, which would be right.
    const auto queries = one.surfaceQueries(3000, 0.05f);
    const auto difference = compareLight(*lightAt(two.field, queries), *lightAt(one.field, queries));
    SidesDifference d{difference->rms, 0};
    for (int probe = 0; probe < probeCount(grid); ++probe) d.solid += test::probeBackfaceShare(one.field, probe) > 0.3f;
    return d;
}

// A layer of probes lies in the plane of the wall between the rooms.
TEST(FieldSides, roomsAreTheSameWithDoubleSidedWalls) {
    for (const char* name : {"two-rooms", "dark-room"}) {
        const SidesDifference d = measureSides(name, {{-7, -1.2f, -4}, glm::vec3(1), {15, 6, 9}}, 24);
        EXPECT_GT(d.solid, 15) << name;
        EXPECT_LT(d.rms, 1e-3) << name;
    }
}

// Thick walls, ground, furniture, and closed leaves that intersect each other.
TEST(FieldSides, theHouseIsTheSameWithDoubleSidedWalls) {
    const Scene scene = *makeBuiltinScene("house");
    const VolumeDesc grid = *placeVolume(poseAt(scene).bounds, {.targetProbes = 1500});
    const SidesDifference d = measureSides("house", grid, 24);
    EXPECT_GT(d.solid, 15);
    EXPECT_LT(d.rms, 0.02);
    RecordProperty("rms", std::to_string(d.rms));
    RecordProperty("solid", d.solid);
}

}  // namespace
}  // namespace probegi
