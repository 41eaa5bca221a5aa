// Baking masks: what places see, against closed forms and direct visibility.
#include <gmock/gmock.h>

#include <bit>

#include "halls.h"
#include "kernels/guards/masks.h"
#include "probegi/builtin_scenes.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

/// Calls body(lowest slot, base) for each cell of a volume that begins at slot 0.
template <class Body>
void forCells(const VolumeDesc& v, const Body& body) {
    for (int z = 0; z + 1 < v.counts.z; ++z)
        for (int y = 0; y + 1 < v.counts.y; ++y)
            for (int x = 0; x + 1 < v.counts.x; ++x) body(x + v.counts.x * (y + v.counts.y * z), glm::ivec3(x, y, z));
}

int cornerSlot(const VolumeDesc& v, int lowest, int corner) {
    return lowest + (corner & 1) + v.counts.x * ((corner >> 1 & 1) + v.counts.y * (corner >> 2));
}

bool visible(const Tracer& tracer, glm::vec3 from, glm::vec3 to) {
    const Ray ray = sightRay(from, to, 0.0f);
    std::uint8_t blocked = 0;
    EXPECT_TRUE(tracer.occluded(std::span(&ray, 1), std::span(&blocked, 1)));
    return blocked == 0;
}

TEST(BakeMasks, eightClustersAreVisibilityItself) {
    const Halls halls(0.17f);
    const FieldDesc field = Halls::field();
    const VolumeDesc& v = field.volumes[0];
    const auto masks = halls.bake({.clusters = 8, .factor = 4});
    EXPECT_EQ(masks->report().residual, 0);
    int agree = 0, less = 0, more = 0;
    forCells(v, [&](int lowest, glm::ivec3 base) {
        for (int t = 0; t < 64; ++t) {
            const glm::ivec3 texel(t & 3, t >> 2 & 3, t >> 4);
            const glm::vec3 place = v.origin + (glm::vec3(base) + glm::vec3(texel) / 3.0f) * v.spacing;
            for (int corner = 0; corner < 8; ++corner) {
                const int slot = cornerSlot(v, lowest, corner);
                const bool seen = visible(*halls.tracer, probePosition(v, slot), place);
                const bool masked = (maskAt(*masks, lowest, texel) >> masks->cluster(slot) & 1u) != 0;
                agree += seen == masked;
                less += seen && !masked;
                more += masked && !seen;
            }
        }
    });
    // Beside the wall, texels keep only what both sides see. (0.4 m from both: 1 of 3 texels; of 7 x 5 x 7 cells.)
    EXPECT_EQ(more, 0);
    EXPECT_LT(less, 0.1 * agree);
    EXPECT_GT(less, 0) << "the wall has no thickness, so some texels must be on neither side";
}

TEST(BakeMasks, noTexelSeesBothSidesOfAWall) {
    const Halls halls(0.17f);
    const FieldDesc field = Halls::field();
    const VolumeDesc& v = field.volumes[0];
    for (const int clusters : {2, 3, 4, 6, 8}) {
        const auto masks = halls.bake({.clusters = clusters, .factor = 6});
        forCells(v, [&](int lowest, glm::ivec3 base) {
            for (int t = 0; t < 216; ++t) {
                const glm::ivec3 texel(t % 6, t / 6 % 6, t / 36);
                const glm::vec3 place = v.origin + (glm::vec3(base) + glm::vec3(texel) / 5.0f) * v.spacing;
                for (int corner = 0; corner < 8; ++corner) {
                    const int slot = cornerSlot(v, lowest, corner);
                    const bool across = (place.x < 0.17f) != (probePosition(v, slot).x < 0.17f);
                    if (across && (maskAt(*masks, lowest, texel) >> masks->cluster(slot) & 1u)) {
                        ADD_FAILURE() << clusters << " clusters, cell " << lowest << ", texel " << t;
                        return;
                    }
                }
            }
        });
    }
}

TEST(BakeMasks, withoutGeometryAllIsSeen) {
    Scene scene;
    const Halls none(std::move(scene), 1);
    const auto masks = none.bake();
    EXPECT_EQ(masks->report().cubes, 1u);
    forCells(masks->volumes()[0], [&](int lowest, glm::ivec3) { EXPECT_EQ(maskAt(*masks, lowest, {3, 4, 5}), 255u); });
    for (int slot = 0; slot < probeCount(Halls::field()); ++slot) EXPECT_LT(masks->cluster(slot), 4);
}

TEST(BakeMasks, inMatterNothingIsSeen) {
    // Walls closer than texels.
    Scene scene;
    scene.materials.resize(1);
    Primitive slabs;
    for (int i = 0; i < 40; ++i) {
        const float at = 0.0131f + 0.025f * float(i);
        addQuad(slabs, {at, -1, -1}, {0, 0, 3}, {0, 3, 0});
        addQuad(slabs, {-1, at, -1}, {3, 0, 0}, {0, 0, 3});
        addQuad(slabs, {-1, -1, at}, {0, 3, 0}, {3, 0, 0});
    }
    addObject(scene, std::move(slabs));
    const Halls solid(std::move(scene), 1);
    FieldDesc field;  // one cell, from 0 to 1
    const auto masks = solid.bake({.clusters = 1}, field);
    EXPECT_EQ(masks->report().cells, 1u);
    EXPECT_EQ(masks->report().blindTexels, 1);
    EXPECT_EQ(maskAt(*masks, 0, {0, 0, 0}), 0u) << "a texel on a probe in matter";
}

TEST(BakeMasks, cellsAwayFromOccludersNeedNoRays) {
    const Halls halls(0.17f);
    MaskDesc desc{.factor = 4};
    const auto some = halls.bake(desc);
    desc.occluders = {};
    const auto all = bakeMasks(halls.context, *halls.tracer, Halls::field(), desc).value();
    EXPECT_LT(some->report().blocked, all->report().blocked);
    EXPECT_LT(some->report().rays, all->report().rays);
    EXPECT_TRUE(std::equal(some->words().begin(), some->words().end(), all->words().begin(), all->words().end()));
}

TEST(BakeMasks, areTheSameForAnyNumberOfThreads) {
    const auto one = Halls(0.17f, 1).bake(), two = Halls(0.17f, 2).bake();
    EXPECT_TRUE(std::equal(one->words().begin(), one->words().end(), two->words().begin(), two->words().end()));
    const auto other = Halls(0.17f, 2).bake({.seed = 2});
    EXPECT_FALSE(std::equal(one->words().begin(), one->words().end(), other->words().begin(), other->words().end()));
}

TEST(BakeMasks, moreClustersLeaveLess) {
    const Halls house(makeBuiltinScene("house").value(), 2);
    FieldDesc field;
    const glm::vec3 size = house.pose.bounds.size();
    field.volumes = {{house.pose.bounds.lower, size / glm::vec3(11, 7, 11), {12, 8, 12}}};
    double last = 1;
    for (const int clusters : {1, 2, 3, 4, 6, 8}) {
        const MaskReport report = house.bake({.clusters = clusters, .factor = 4}, field)->report();
        EXPECT_LT(report.residual, last) << clusters;
        EXPECT_GT(report.meanClusters, 0);
        last = report.residual;
        if (clusters == 4) {
            EXPECT_LT(report.residual, 0.006);
        }
    }
    EXPECT_EQ(last, 0);
}

TEST(BakeMasks, strictSeesAllProbesOfAClusterOrNone) {
    const Halls halls(makeBuiltinScene("two-rooms").value(), 2);
    FieldDesc field;
    const glm::vec3 size = halls.pose.bounds.size();
    field.volumes = {{halls.pose.bounds.lower, size / glm::vec3(11, 7, 11), {12, 8, 12}}};
    const VolumeDesc& v = field.volumes[0];
    const auto masks = halls.bake({.clusters = 3, .factor = 4, .strict = true}, field);
    int leaks = 0;
    forCells(v, [&](int lowest, glm::ivec3 base) {
        for (int t = 0; t < 64; ++t) {
            const glm::ivec3 texel(t & 3, t >> 2 & 3, t >> 4);
            const glm::vec3 place = probePosition(v, lowest) + glm::vec3(texel) / 3.0f * v.spacing;
            for (int corner = 0; corner < 8; ++corner) {
                const int slot = cornerSlot(v, lowest, corner);
                leaks += (maskAt(*masks, lowest, texel) >> masks->cluster(slot) & 1u) &&
                         !visible(*halls.tracer, probePosition(v, slot), place);
            }
        }
        (void)base;
    });
    EXPECT_EQ(leaks, 0);
}

TEST(BakeMasks, linksTellWhichNeighboursAProbeSees) {
    const Halls halls(0.17f);
    const FieldDesc field = Halls::field();
    const VolumeDesc& v = field.volumes[0];
    const auto masks = halls.bake();
    const auto links = [&](int slot) { return masks->words()[2 * std::size_t(slot) + 1] >> 8; };
    // Cell (3, 1, 1) stands at x = -0.2, its neighbour at 0.5, on the other side of the wall.
    const int slot = 3 + v.counts.x * (1 + v.counts.y);
    EXPECT_EQ(links(slot) & 3u, 1u);
    EXPECT_EQ(links(slot + 1) & 3u, 2u);
    EXPECT_EQ(links(slot) >> 3 & 1u, 1u) << "up the y axis";
}

TEST(BakeMasks, manyVolumesHaveTheirOwn) {
    const Halls halls(0.17f);
    FieldDesc both = Halls::field();
    both.volumes.push_back({{-1.9f, 0.3f, -1.9f}, glm::vec3(0.5f), {3, 4, 5}});
    FieldDesc second;
    second.volumes = {both.volumes[1]};
    const auto together = halls.bake({.clusters = 8}, both), alone = halls.bake({.clusters = 8}, second);
    const int first = probeCount(both.volumes[0]);
    forCells(second.volumes[0], [&](int lowest, glm::ivec3) {
        EXPECT_EQ(maskAt(*together, first + lowest, {1, 2, 7}), maskAt(*alone, lowest, {1, 2, 7}));
    });
}

TEST(BakeMasks, movedProbesSeeFromWhereTheyStand) {
    const Halls halls(0.17f);
    const FieldDesc field = Halls::field();
    const VolumeDesc& v = field.volumes[0];
    std::vector<glm::vec3> places;
    for (int i = 0; i < probeCount(v); ++i) places.push_back(probePosition(v, i));
    const int slot = 3 + v.counts.x * (1 + v.counts.y);
    places[std::size_t(slot)].x = 0.25f;  // through the wall
    const auto masks = halls.bake({.clusters = 8, .factor = 4, .positions = places});
    EXPECT_EQ(masks->words()[2 * std::size_t(slot) + 1] >> 8 & 3u, 2u);
    const unsigned right = maskAt(*masks, slot, {3, 1, 1});
    EXPECT_TRUE(right >> masks->cluster(slot) & 1u);
}

TEST(BakeMasks, refusesWhatItCannotDo) {
    const Halls halls;
    const auto complaint = [&](const MaskDesc& desc, const FieldDesc& field = Halls::field()) {
        const auto baked = bakeMasks(halls.context, *halls.tracer, field, desc);
        return baked ? std::string() : baked.error().message;
    };
    EXPECT_THAT(complaint({.clusters = 0}), HasSubstr("clusters is 0; it must be 1 to 8"));
    EXPECT_THAT(complaint({.clusters = 9}), HasSubstr("clusters is 9"));
    EXPECT_THAT(complaint({.factor = 1}), HasSubstr("factor is 1; it must be 2 to 16"));
    EXPECT_THAT(complaint({.factor = 17}), HasSubstr("factor is 17"));
    EXPECT_THAT(complaint({.sweeps = -1}), HasSubstr("sweeps"));
    EXPECT_THAT(complaint({.sparsity = std::nanf("")}), HasSubstr("sparsity"));
    const std::vector<glm::vec3> few(3);
    EXPECT_THAT(complaint({.positions = few}), HasSubstr("3 positions for 384 probes"));
    std::vector<glm::vec3> nowhere(384);
    nowhere[7].y = std::nanf("");
    EXPECT_THAT(complaint({.positions = nowhere}), HasSubstr("not finite"));
    const std::vector<Bounds> odd{{glm::vec3(std::nanf("")), glm::vec3(1)}};
    EXPECT_THAT(complaint({.occluders = odd}), HasSubstr("not numbers"));
    FieldDesc tracking = Halls::field();
    tracking.volumes[0].tracksCamera = true;
    EXPECT_THAT(complaint({}, tracking), HasSubstr("track a camera"));
    FieldDesc bad = Halls::field();
    bad.raysPerProbe = 1;
    EXPECT_THAT(complaint({}, bad), HasSubstr("raysPerProbe"));
}

TEST(BakeMasks, canBeCancelled) {
    const Halls halls;
    const Context impatient = *Context::create({.threads = 1, .progress = [](const ProgressReport&) { return false; }});
    const auto baked = bakeMasks(impatient, *halls.tracer, Halls::field(), {.sweeps = 100'000});
    ASSERT_FALSE(baked);
    EXPECT_EQ(baked.error().code, ErrorCode::cancelled);
}

TEST(BakeMasks, extremesOfTheDescWork) {
    const Halls halls(0.17f);
    FieldDesc cell;
    cell.volumes = {{{-0.3f, 1, 0}, glm::vec3(1), {2, 2, 2}}};
    for (const int factor : {2, 3, 16})
        for (const int clusters : {1, 8}) EXPECT_EQ(halls.bake({clusters, factor}, cell)->report().cells, 1u);
    const float huge = std::numeric_limits<float>::infinity();
    const std::vector<Bounds> all{{glm::vec3(-huge), glm::vec3(huge)}};
    EXPECT_EQ(bakeMasks(halls.context, *halls.tracer, cell, {.occluders = all}).value()->report().blocked, 1u);
    EXPECT_TRUE(halls.tryBake({.sweeps = 0, .sparsity = 0}, cell));
}

}  // namespace
}  // namespace probegi::test
