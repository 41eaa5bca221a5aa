// The graph of section 3.3 and its colouring.
#include "mask/colouring.h"

#include <gmock/gmock.h>

#include <set>

#include "halls.h"
#include "probegi/builtin_scenes.h"

namespace probegi::test {
namespace {

/// A graph from a scene.
struct Baked {
    Baked(const Halls& halls, const FieldDesc& field, int factor)
        : cells(findMaskCells(field, {.factor = factor}, halls.tracer->bounds())),
          sight(traceProbeSight(halls.context, *halls.tracer, field, cells, factor).value()),
          graph(halls.context, field, cells, sight, factor) {}

    MaskCells cells;
    ProbeSight sight;
    ProbeGraph graph;
};

const Halls& house() {
    static const Halls halls(makeBuiltinScene("house").value(), 2);
    return halls;
}

FieldDesc houseField() {
    FieldDesc field;
    field.volumes = {{house().pose.bounds.lower, house().pose.bounds.size() / glm::vec3(15, 7, 15), {16, 8, 16}}};
    return field;
}

const Baked& houseGraph() {
    static const Baked baked(house(), houseField(), 4);
    return baked;
}

TEST(ProbeGraph, sumsWhatTwoProbesSeeApart) {
    // One cell of 1 m with a wall across the middle, two texels an axis: each texel lies on a probe and weighs for it
    // alone, so no pair has a common weight; with three, the texels between two probes weigh a half for both.
    const Halls halls(0.0f);
    FieldDesc field;
    field.volumes = {{{-0.3f, 1, 0}, glm::vec3(1), {2, 2, 2}}};
    const auto edge = [&](int factor, std::size_t other) {
        const Baked baked(halls, field, factor);
        float found = -1;
        baked.graph.forNeighbours(0, [&](std::size_t to, float difference) {
            if (to == other) found = difference;
        });
        return found;
    };
    EXPECT_EQ(edge(2, 1), 0);
    // Along x: the texels that both reach with weight have x = 0.5; on the edge itself 1/2, beside it on two faces 1/4
    // each, in the middle 1/8.
    EXPECT_FLOAT_EQ(edge(3, 1), 0.5f + 2 * 0.25f + 0.125f);
    EXPECT_EQ(edge(3, 2), 0) << "both see the same";
}

TEST(ProbeGraph, isTheSameFromBothEnds) {
    const ProbeGraph& graph = houseGraph().graph;
    float largest = 0;
    for (std::size_t slot = 0; slot < graph.probes(); slot += 7)
        graph.forNeighbours(slot, [&](std::size_t other, float difference) {
            int met = 0;
            graph.forNeighbours(other, [&](std::size_t back, float same) {
                if (back != slot) return;
                ++met;
                EXPECT_EQ(same, difference);
            });
            EXPECT_EQ(met, 1);
            largest = std::max(largest, difference);
        });
    EXPECT_GT(largest, 0);
    EXPECT_LE(largest, graph.largest());
}

TEST(Colouring, parityPartsTheProbesOfEachCell) {
    const ProbeGraph& graph = houseGraph().graph;
    const Clusters clusters = parityClusters(graph);
    for (const MaskCell& cell : houseGraph().cells.blocked) {
        std::set<int> colours;
        for (const int slot : cell.slot) colours.insert(clusters[std::size_t(slot)]);
        ASSERT_EQ(colours.size(), 8u);
    }
    EXPECT_EQ(colouringLoss(graph, clusters, 0), 0);
}

TEST(Colouring, divisionHasEveryCluster) {
    for (int k = 1; k <= 8; ++k) {
        const Clusters clusters = convexDivision(houseGraph().graph, k);
        std::vector<int> probes(std::size_t(k), 0);
        for (const std::uint8_t cluster : clusters) ++probes.at(cluster);
        for (const int count : probes) EXPECT_GT(count, int(clusters.size()) / (2 * k)) << k;
    }
}

TEST(Colouring, annealingBeatsItsStart) {
    const ProbeGraph& graph = houseGraph().graph;
    for (const int k : {2, 3, 4, 6}) {
        const Clusters start = convexDivision(graph, k);
        const Clusters found = annealColours(house().context, graph, start, {.clusters = k}).value();
        const Clusters greedy = annealColours(house().context, graph, start, {.clusters = k, .sweeps = 0}).value();
        EXPECT_LT(colouringLoss(graph, greedy, 0.001f), colouringLoss(graph, start, 0.001f));
        EXPECT_LT(colouringLoss(graph, found, 0.001f), 0.9 * colouringLoss(graph, greedy, 0.001f)) << k;
    }
}

TEST(Colouring, seedsAgree) {
    const ProbeGraph& graph = houseGraph().graph;
    std::vector<double> losses;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const auto found =
            annealColours(house().context, graph, convexDivision(graph, 3), {.clusters = 3, .seed = seed});
        losses.push_back(colouringLoss(graph, *found, 0.001f));
    }
    const auto [least, most] = std::minmax_element(losses.begin(), losses.end());
    EXPECT_LT(*most, 1.05 * *least);
    EXPECT_NE(*most, *least) << "the seed decides something";
}

TEST(Colouring, lossCountsPairsOnce) {
    const ProbeGraph& graph = houseGraph().graph;
    double all = 0;
    std::size_t equalPairs = 0;
    for (std::size_t slot = 0; slot < graph.probes(); ++slot)
        graph.forNeighbours(slot, [&](std::size_t other, float difference) {
            if (other < slot) return;
            all += double(difference);
            equalPairs += !(difference > 0.0f);
        });
    EXPECT_NEAR(colouringLoss(graph, Clusters(graph.probes()), 0.5f), all, 1e-6 * all);
    // With eight colours by parity every pair has two.
    EXPECT_NEAR(colouringLoss(graph, parityClusters(graph), 0.5f), 0.5 * double(equalPairs), 1e-3);
}

}  // namespace
}  // namespace probegi::test
