// Baking masks: what places see, against closed forms and direct visibility.
#include <gmock/gmock.h>

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

/// One ray; batches may decide otherwise for rays that graze an edge.
bool visible(const Halls& halls, const MaskCell& cell, std::size_t corner, glm::ivec3 texel) {
    const Ray ray = sightRay(cell.probe[corner], cell.texel(texel.x, texel.y, texel.z), 0.0f);
    std::uint8_t blocked = 0;
    EXPECT_TRUE(halls.tracer->occluded(std::span(&ray, 1), std::span(&blocked, 1)));
    return blocked == 0;
}

TEST(BakeMasks, eightClustersAreVisibilityItself) {
    const Halls halls(0.17f);
    const auto masks = halls.bake({.clusters = 8, .factor = 4});
    EXPECT_EQ(masks->report().residual, 0);
    int hidden = 0, seen = 0, differ = 0;
    for (const MaskCell& cell : findMaskCells(Halls::field(), {.factor = 4, .occluders = halls.occluders}, {}).blocked)
        for (int t = 0; t < 64; ++t) {
            const glm::ivec3 texel(t & 3, t >> 2 & 3, t >> 4);
            for (std::size_t corner = 0; corner < 8; ++corner) {
                const bool there = visible(halls, cell, corner, texel);
                const bool masked =
                    (maskAt(*masks, cell.slot[0], texel) >> masks->cluster(cell.slot[corner]) & 1u) != 0;
                ++(there ? seen : hidden);
                // A texel on a probe sees no more than others there do.
                differ += there != masked && cell.probe[corner] != cell.texel(texel.x, texel.y, texel.z);
            }
        }
    EXPECT_GT(hidden, 10'000);
    EXPECT_GT(seen, 10'000);
    EXPECT_LE(differ, (hidden + seen) / 1000);
}

TEST(BakeMasks, noTexelSeesBothSidesOfAWall) {
    const Halls halls(0.17f);
    const auto inside = [](glm::vec3 at) { return std::abs(at.x) < 2 && std::abs(at.z) < 2 && at.y > 0 && at.y < 3; };
    for (const int clusters : {4, 6, 8}) {
        const auto masks = halls.bake({.clusters = clusters, .factor = 6});
        int leaks = 0, parted = 0;
        for (const MaskCell& cell : findMaskCells(Halls::field(), {.factor = 6}, halls.tracer->bounds()).blocked)
            for (int t = 0; t < 216; ++t) {
                const glm::ivec3 texel(t % 6, t / 6 % 6, t / 36);
                const glm::vec3 place = cell.texel(texel.x, texel.y, texel.z);
                for (std::size_t i = 0; i < 8; ++i) {
                    if (!inside(place) || !inside(cell.probe[i])) continue;
                    if ((place.x < 0.17f) == (cell.probe[i].x < 0.17f)) continue;
                    ++parted;
                    leaks += maskAt(*masks, cell.slot[0], texel) >> masks->cluster(cell.slot[i]) & 1u;
                }
            }
        EXPECT_GT(parted, 5000);
        EXPECT_EQ(leaks, 0) << clusters << " clusters";
    }
}

TEST(BakeMasks, wallsBetweenTexelsHaveTheirPlace) {
    // Cells begin at x = -2.3 + 0.7 i; texels are 0.1 m apart. The wall is 0.03 m beyond texel 3 of cell 3.
    const Halls halls(0.13f);
    const auto masks = halls.bake({.clusters = 8});
    const VolumeDesc v = Halls::field().volumes[0];
    const int slot = 3 + v.counts.x * (2 + v.counts.y * 3);
    for (int x = 0; x < 7; ++x) {
        const unsigned place = texelAt(*masks, slot, {x, 3, 3}) >> 4 & 15u;
        EXPECT_EQ(place, x == 3 ? 1u + 4u : 0u) << x;  // 0.3 of 14
    }
    EXPECT_EQ(texelAt(*masks, slot, {3, 3, 3}) >> 8 & 0xffu, 0u) << "along the wall there is none";
}

TEST(BakeMasks, withoutGeometryAllIsSeen) {
    Scene scene;
    const Halls none(std::move(scene), 1);
    const auto masks = none.bake();
    EXPECT_EQ(masks->report().cubes, 1u);
    forCells(masks->volumes()[0], [&](int lowest, glm::ivec3) { EXPECT_EQ(texelAt(*masks, lowest, {3, 4, 5}), 15u); });
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
    // Their cubes come in another order.
    forCells(some->volumes()[0], [&](int lowest, glm::ivec3) {
        ASSERT_EQ(some->cluster(lowest), all->cluster(lowest));
        for (int t = 0; t < 64; ++t) {
            const glm::ivec3 texel(t & 3, t >> 2 & 3, t >> 4);
            ASSERT_EQ(texelAt(*some, lowest, texel), texelAt(*all, lowest, texel)) << lowest;
        }
    });
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
            EXPECT_LT(report.residual, 0.01);
        }
    }
    EXPECT_EQ(last, 0);
}

TEST(BakeMasks, strictSeesAllProbesOfAClusterOrNone) {
    const Halls halls(makeBuiltinScene("two-rooms").value(), 2);
    FieldDesc field;
    const glm::vec3 size = halls.pose.bounds.size();
    field.volumes = {{halls.pose.bounds.lower, size / glm::vec3(11, 7, 11), {12, 8, 12}}};
    const auto masks = halls.bake({.clusters = 3, .factor = 4, .strict = true}, field);
    const MaskCells cells = findMaskCells(field, {.factor = 4, .occluders = halls.occluders}, {});
    const ProbeSight sight = traceProbeSight(halls.context, *halls.tracer, field, cells, 4).value();
    int used = 0, leaks = 0;
    for (std::size_t c = 0; c < cells.blocked.size(); ++c)
        for (int t = 0; t < 64; ++t) {
            const MaskCell& cell = cells.blocked[c];
            const unsigned mask = maskAt(*masks, cell.slot[0], glm::ivec3(t & 3, t >> 2 & 3, t >> 4));
            const unsigned seen = sight.seen[64 * c + std::size_t(t)];
            unsigned missed[3] = {}, whole = 0;
            for (std::size_t i = 0; i < 8; ++i) missed[masks->cluster(cell.slot[i])] |= ~seen & 1u << i;
            for (std::size_t i = 0; i < 8; ++i) whole |= missed[masks->cluster(cell.slot[i])] == 0 ? 1u : 0u;
            if (whole == 0) continue;  // what sees no cluster goes by its neighbours
            for (std::size_t i = 0; i < 8; ++i) {
                if (!(mask >> masks->cluster(cell.slot[i]) & 1u)) continue;
                ++used;
                leaks += !(seen >> i & 1);
            }
        }
    EXPECT_EQ(leaks, 0);
    EXPECT_GT(used, 10'000);
    EXPECT_GT(halls.bake({.clusters = 3, .factor = 4}, field)->report().residual, 0) << "this could leak";
}

TEST(BakeMasks, behindThingsARoomIsStillTheRoom) {
    // A cell of 2 m, and in it a board that hides all its probes from what is below; open all around.
    Scene scene;
    scene.materials.resize(1);
    Primitive boards;
    addBox(boards, {0.3f, 0.55f, 0.3f}, {1.7f, 0.6f, 1.7f});
    addBox(boards, {0.3f, 0.1f, 0.3f}, {1.7f, 0.15f, 1.7f});
    addBox(boards, {0.3f, 0.1f, 0.3f}, {0.35f, 0.6f, 1.7f});
    addBox(boards, {1.65f, 0.1f, 0.3f}, {1.7f, 0.6f, 1.7f});
    addBox(boards, {0.3f, 0.1f, 0.3f}, {1.7f, 0.6f, 0.35f});
    addObject(scene, std::move(boards));
    const Halls open(std::move(scene), 1);
    FieldDesc cell;
    cell.volumes = {{glm::vec3(0), glm::vec3(2), {2, 2, 2}}};
    const auto masks = open.bake({.clusters = 8}, cell);
    // The texel (4, 1, 3) is at (1.14, 0.29, 0.86), in a box that is open towards +z.
    EXPECT_NE(maskAt(*masks, 0, {4, 1, 3}), 0u);
    // Where the box is closed as well, nothing reaches it.
    Scene closed;
    closed.materials.resize(1);
    Primitive box;
    addBox(box, {0.3f, 0.1f, 0.3f}, {1.7f, 0.6f, 1.7f});
    addObject(closed, std::move(box));
    EXPECT_EQ(maskAt(*Halls(std::move(closed), 1).bake({.clusters = 8}, cell), 0, {4, 1, 3}), 0u);
}

TEST(BakeMasks, texelsOnAWallAreOnNoSide) {
    // A sheet across the middle texels of a cell, which it passes exactly.
    Scene scene;
    scene.materials.resize(1);
    Primitive sheet;
    addQuad(sheet, {0.5f, -1, -1}, {0, 0, 3}, {0, 3, 0});
    addObject(scene, std::move(sheet));
    const Halls halls(std::move(scene), 1);
    const auto masks = halls.bake({.clusters = 8, .factor = 5}, FieldDesc{});  // one cell, from 0 to 1
    unsigned left = 0;
    for (int slot = 0; slot < 8; slot += 2) left |= 1u << masks->cluster(slot);
    for (int t = 0; t < 125; ++t) {
        const glm::ivec3 texel(t % 5, t / 5 % 5, t / 25);
        const unsigned mask = maskAt(*masks, 0, texel);
        EXPECT_EQ(mask, texel.x < 2 ? left : texel.x > 2 ? ~left & 255u : 0u) << t;
    }
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
