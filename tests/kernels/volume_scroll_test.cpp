// Scrolled volumes: which slot has which probe.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "kernels/volume/volume.h"

namespace probegi::kernels {
namespace {

Volume scrolledVolume(ivec3 cells) {
    Volume v{};
    v.counts = ivec3(5, 2, 7);
    v.firstSlot = 11;
    v.phase = (cells % v.counts + v.counts) % v.counts;
    return v;
}

template <class Body>
void forEachCell(const Volume& v, const Body& body) {
    for (int z = 0; z < v.counts.z; ++z)
        for (int y = 0; y < v.counts.y; ++y)
            for (int x = 0; x < v.counts.x; ++x) body(ivec3(x, y, z));
}

// Any walk, steps beyond the window's size among them: a slot belongs to the same place of the world until that place
// leaves the window, and hasEntered() says exactly which slots change hands.
TEST(Scroll, placesKeepTheirSlotsWhileTheyStay) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> small(-2, 2), large(-30, 30);
    std::map<std::tuple<int, int, int>, int> slotOf;  // of places in the world, in cells
    ivec3 at(0);
    forEachCell(scrolledVolume(at), [&](ivec3 cell) {
        slotOf[{cell.x, cell.y, cell.z}] = probeSlot(scrolledVolume(at), cell);
    });
    for (int step = 0; step < 200; ++step) {
        auto& way = step % 20 == 19 ? large : small;
        const ivec3 cells(way(random), way(random), way(random));
        at += cells;
        const Volume v = scrolledVolume(at);
        std::map<std::tuple<int, int, int>, int> now;
        forEachCell(v, [&](ivec3 cell) {
            const ivec3 place = cell + at;
            const int slot = probeSlot(v, cell);
            EXPECT_EQ(probeCell(v, slot), cell);
            const auto before = slotOf.find({place.x, place.y, place.z});
            EXPECT_EQ(hasEntered(v, cell, cells), before == slotOf.end());
            if (before != slotOf.end()) {
                EXPECT_EQ(before->second, slot);
            }
            now[{place.x, place.y, place.z}] = slot;
        });
        slotOf = std::move(now);
        ASSERT_EQ(slotOf.size(), 70u);
    }
}

TEST(Scroll, numbersGoByTheCell) {
    for (const ivec3 cells : {ivec3(0), ivec3(3, -1, 12)}) {
        const Volume v = scrolledVolume(cells);
        int number = 0;
        forEachCell(v, [&](ivec3 cell) { EXPECT_EQ(probeNumber(v, probeSlot(v, cell)), number++); });
    }
}

}  // namespace
}  // namespace probegi::kernels
