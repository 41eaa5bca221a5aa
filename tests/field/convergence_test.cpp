// The bookkeeping of Field::converge against rooms where every update is a closed form: the new light is that of the
// lamps plus the albedo times the previous light.
#include "field/convergence.h"
#include "field/layout.h"
#include "support/field_setup.h"
#include "support/memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace probegi {
namespace {

using test::FieldSetup;

// Blocks of 4 x 4 x 4 probes along x, each a room of its own.
struct Room {
    double light = 1;   ///< from the lamps
    double albedo = 0;  ///< the room converges to light / (1 - albedo)
    double noise = 0;   ///< standard deviation of an update's light, relative, the same at all its probes
    float backfaceShare = 0;
    double truth() const { return light / (1 - albedo); }
};

struct Ending {
    std::vector<double> rooms;  ///< light
    Convergence books;
};

Ending converge(const std::vector<Room>& rooms, float tolerance, int maxUpdates, int seed = 1) {
    FieldSetup desc;
    desc.volumes[0].counts = {4 * int(rooms.size()), 4, 4};
    Ending end{std::vector<double>(rooms.size()), Convergence(desc, makeVolumes(desc), tolerance, maxUpdates)};
    std::mt19937 random{std::uint32_t(seed)};
    std::normal_distribution<double> normal;
    std::vector<double> turned(rooms.size());
    const auto probes = std::size_t(probeCount(desc));
    while (end.books.updates() < maxUpdates && !end.books.converged()) {
        const double kept = end.books.kept().irradiance;
        for (std::size_t i = 0; i < rooms.size(); ++i) {
            if (end.books.turnsRays()) turned[i] = 1 + rooms[i].noise * normal(random);
            const double now = turned[i] * (rooms[i].light + rooms[i].albedo * end.rooms[i]);
            end.rooms[i] = std::max(0.0, kept * end.rooms[i] + (1 - kept) * now);
        }
        std::vector<float> brightness, shares;
        for (std::size_t p = 0; p < probes && end.books.observes(); ++p) {
            const std::size_t room = p % (4 * rooms.size()) / 4;
            brightness.push_back(float(end.rooms[room]));
            shares.push_back(rooms[room].backfaceShare);
        }
        end.books.advance(brightness, shares);
    }
    return end;
}

TEST(Convergence, everyRoomArrivesHoweverBright) {
    const std::vector<Room> rooms{{1, 0.5}, {1e-3, 0.8}, {10, 0.0}, {0.01, 0.9}};
    const Ending end = converge(rooms, 0.01f, 128);
    EXPECT_TRUE(end.books.converged());
    EXPECT_LT(end.books.remaining(), 0.01f);
    EXPECT_LE(end.books.updates(), 64);
    for (std::size_t i = 0; i < rooms.size(); ++i) EXPECT_NEAR(end.rooms[i] / rooms[i].truth(), 1, 0.01) << i;
}

// With one albedo everywhere, two differences predict the limit, and one update steps there.
TEST(Convergence, stepsAheadOfManyBounces) {
    for (const double albedo : {0.5, 0.8, 0.9, 0.95, 0.99}) {
        const std::vector<Room> rooms{{1, albedo}, {0.1, albedo}};
        const Ending end = converge(rooms, 0.01f, 128);
        EXPECT_TRUE(end.books.converged()) << albedo;
        EXPECT_LE(end.books.updates(), 24) << albedo;
        for (std::size_t i = 0; i < rooms.size(); ++i) EXPECT_NEAR(end.rooms[i] / rooms[i].truth(), 1, 1e-3) << albedo;
    }
}

struct Averaged {
    double updates = 0;  ///< mean
    double within = 0;   ///< share of the runs that end within the tolerance
};

Averaged average(const std::vector<Room>& rooms, float tolerance) {
    constexpr int kRuns = 400;
    Averaged result;
    for (int run = 0; run < kRuns; ++run) {
        const Ending end = converge(rooms, tolerance, 1000, run);
        EXPECT_TRUE(end.books.converged());
        result.updates += double(end.books.updates()) / kRuns;
        result.within += std::abs(end.rooms[0] / rooms[0].truth() - 1) < tolerance ? 1.0 / kRuns : 0.0;
    }
    return result;
}

// Stops when one and a half standard errors of the noisiest room are within the tolerance. Noise shared by a whole room
// returns with the bounces, which the scatter of the updates does not show, so the limit is met less often.
TEST(Convergence, noiseIsAveragedUntilItIsSmall) {
    const Averaged direct = average({{1, 0, 0.03}, {1e-2, 0, 0.01}}, 0.02f);
    EXPECT_GT(direct.within, 0.75) << direct.updates;
    EXPECT_GT(direct.updates, 12);
    EXPECT_LT(direct.updates, 40);
    EXPECT_GT(average({{1, 0.5, 0.03}, {1e-2, 0.5, 0.01}}, 0.02f).within, 0.6);
    // Twice the noise takes about four times the updates.
    const double more = average({{1, 0, 0.06}, {1e-2, 0, 0.01}}, 0.02f).updates;
    EXPECT_GT(more, 2 * direct.updates);
    EXPECT_LT(more, 6 * direct.updates);
}

TEST(Convergence, reachingTheCapIsReported) {
    const Ending noisy = converge({{1, 0.5, 0.5}}, 0.01f, 32);
    EXPECT_FALSE(noisy.books.converged());
    EXPECT_EQ(noisy.books.updates(), 32);
    EXPECT_GT(noisy.books.remaining(), 0.01f);
    EXPECT_LT(noisy.books.remaining(), 2.0f);
    // Too few updates for the bounces: the estimate of the missing light must not be too low.
    const Ending slow = converge({{1, 0.5}, {1, 0.9}, {1, 0.95}}, 0.01f, 24);
    const double missing = 1 - slow.rooms[2] * 0.05;
    EXPECT_TRUE(slow.books.converged() ? missing < 0.01 : missing < 1.5 * slow.books.remaining()) << missing;
    const Ending few = converge({{1, 0.5}}, 0.01f, 3);
    EXPECT_FALSE(few.books.converged());
    EXPECT_TRUE(std::isinf(few.books.remaining()));
}

// Probes in walls, and a room with noise but no light, do not prevent convergence.
TEST(Convergence, wallsAndBlackRoomsDoNotBlock) {
    Room wall{1, 0.5, 0.9};
    wall.backfaceShare = 0.6f;
    const Ending end = converge({{1, 0.5}, wall, {1e-5, 0, 0.9}, {0, 0}}, 0.01f, 128);
    EXPECT_TRUE(end.books.converged());
    EXPECT_LE(end.books.updates(), 24);
    EXPECT_NEAR(end.rooms[0], 2, 0.02);
    EXPECT_TRUE(converge({{0, 0}}, 0.01f, 128).books.converged()) << "all black";
}

// The average's weights 3 / (n + 2) forget the first ray set; distances are averaged over all turned sets.
TEST(Convergence, keepsWhatItSays) {
    FieldSetup desc;
    desc.volumes[0].counts = {4, 4, 4};
    Convergence books(desc, makeVolumes(desc), 0.01f, 4);
    EXPECT_EQ(books.kept().irradiance, 0);
    EXPECT_EQ(books.kept().visibility, 0);
    books.advance({}, {});
    EXPECT_NEAR(books.kept().visibility, 0.5, 1e-6);
    books.advance({}, {});  // half of four updates: the average begins
    EXPECT_EQ(books.kept().irradiance, 0);
    EXPECT_TRUE(books.turnsRays());
    const std::vector<float> light(64, 1.0f), shares(64, 0.0f);
    books.advance(light, shares);
    EXPECT_NEAR(books.kept().irradiance, 0.25, 1e-6);
    EXPECT_NEAR(books.kept().visibility, 0.75, 1e-6);
}

// The estimate of the remaining error: one and a half standard errors of the average, from the updates' scatter, plus
// its drift, which without bounces falls by 2^3 when the number of updates doubles.
TEST(Convergence, whatRemainsIsScatterAndDrift) {
    FieldSetup desc;
    desc.volumes[0].counts = {4, 4, 4};
    Convergence books(desc, makeVolumes(desc), 1e-6f, 1000);
    const std::vector<float> shares(64, 0.0f);
    const auto tell = [&](double light) { books.advance(std::vector<float>(64, float(light)), shares); };
    for (int still = 0; still < 5; ++still) books.observes() ? tell(1) : books.advance({}, {});
    double light = 1, squares = 0;
    std::vector<double> sum;
    for (int n = 1; n <= 21; ++n) {
        ASSERT_NEAR(books.kept().irradiance, 1 - 3.0 / (n + 2), 1e-6) << "the average began";
        EXPECT_NEAR(books.kept().visibility, 1 - 1.0 / (n + 3), 1e-6);
        const double change = (n % 3 == 0 ? -0.02 : 0.03) / n, before = light;
        light *= (2 + change) / (2 - change);  // relative to the mean of both
        tell(light);
        const double seen = (double(float(light)) - double(float(before))) / (0.5 * (light + before));
        sum.push_back((sum.empty() ? 0 : sum.back()) + seen);
        // An update's distance from the average before it, which has noise of its own.
        if (n > 1) squares += std::pow(seen * (n + 2) / 3, 2) / (1 + 9.0 / 5 / (n - 1));
        EXPECT_FALSE(books.converged());
        if (n < 8) continue;
        const double scatter = 1.5 * std::sqrt(9.0 / 5 * squares / (n - 1) / n);
        const double drift = std::abs(sum.back() - sum[std::size_t(n / 2 - 1)]) / (8 - 1);
        EXPECT_NEAR(books.remaining() / (scatter + drift), 1, 1e-3) << n;
    }
}

// Words of the state before its lists: a mark, four whole numbers, four of two words, two flags, a number.
constexpr std::size_t kNumberWords = 1 + 4 + 4 * 2 + 2 + 1;

TEST(Convergence, savedStatesAreChecked) {
    const Ending end = converge({{1, 0.5}, {2, 0.6, 0.02}}, 0.005f, 40);
    std::vector<std::uint32_t> words;
    end.books.save(words);
    FieldSetup desc;
    desc.volumes[0].counts = {8, 4, 4};
    const auto restores = [&](std::vector<std::uint32_t> state) {
        return Convergence(desc, makeVolumes(desc), 0.005f, 40).restore(state);
    };
    EXPECT_TRUE(restores(words));
    constexpr std::size_t kDifferences = 4;
    for (const int differences : {-2, end.books.updates() + 1, std::numeric_limits<int>::max()}) {
        std::vector<std::uint32_t> wrong = words;
        wrong[kDifferences] = std::uint32_t(differences);
        EXPECT_FALSE(restores(wrong)) << differences;
    }
    for (const int differences : {-1, end.books.updates()}) {
        std::vector<std::uint32_t> right = words;
        right[kDifferences] = std::uint32_t(differences);
        EXPECT_TRUE(restores(right)) << differences;
    }
}

TEST(Convergence, aStateOfTooManyRegionsTakesNoMemory) {
    constexpr std::size_t kWords = std::size_t(1) << 23;
    std::vector<std::uint32_t> words;
    converge({{1, 0.5}}, 0.01f, 40).books.save(words);
    words.resize(kNumberWords + 3);  // three lists of no entries
    for (std::size_t list = 0; list < 3; ++list) words[kNumberWords + list] = 0;
    words.resize(kWords);
    words[kNumberWords + 3] = std::uint32_t(kWords - kNumberWords - 4);  // regions
    FieldSetup desc;
    Convergence books(desc, makeVolumes(desc), 0.01f, 40);
    const std::size_t before = test::peakMemory();
    EXPECT_FALSE(books.restore(words));
    EXPECT_LT(test::peakMemory() - before, 2 * kWords * sizeof(std::uint32_t));
}

}  // namespace
}  // namespace probegi
