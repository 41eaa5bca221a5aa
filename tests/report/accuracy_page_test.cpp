#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "markdown.h"

namespace probegi::accuracy {
namespace {

using testing::HasSubstr;

class AccuracyPage : public testing::Test {
protected:
    AccuracyPage() : m_path(testing::TempDir() + "accuracy-page-" + std::to_string(getpid()) + ".md") {}
    ~AccuracyPage() override { std::filesystem::remove(m_path); }

    void write(const std::string& text) { std::ofstream(m_path) << text; }
    std::string read() const {
        std::ifstream file(m_path);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

    std::filesystem::path m_path;
};

TEST_F(AccuracyPage, onlyTheMeasuredPartIsReplaced) {
    write("before\n<!-- measured: begin -->\nold\n<!-- measured: end -->\nafter\n");
    ASSERT_TRUE(replaceBetweenMarkers(m_path, "new\n"));
    EXPECT_EQ(read(), "before\n<!-- measured: begin -->\nnew\n<!-- measured: end -->\nafter\n");
    ASSERT_TRUE(replaceBetweenMarkers(m_path, "newer\n"));
    EXPECT_EQ(read(), "before\n<!-- measured: begin -->\nnewer\n<!-- measured: end -->\nafter\n");
}

TEST_F(AccuracyPage, withoutMarkersNothingIsWritten) {
    write("a page by hand\n");
    const auto done = replaceBetweenMarkers(m_path, "new\n");
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("measured: begin"));
    EXPECT_EQ(read(), "a page by hand\n");
}

TEST_F(AccuracyPage, missingPageIsAnError) {
    EXPECT_FALSE(replaceBetweenMarkers(m_path, "new\n"));
}

TEST(AccuracyTables, leakInPercentAndCentimetres) {
    const std::string text =
        accuracyTables({}, {{0.05f, {0.5, 0.75}, {0.004, 0.0061}, {0.0045, 0.0065}, {0.005, 0.007}}}, 2);
    EXPECT_THAT(text,
                HasSubstr("| 5 cm | 50.00 % | 75.00 % | 0.400 % | 0.610 % | 0.450 % | 0.650 % | 0.500 % | 0.700 % |"));
}

// Every table has both ways of filling a field, the number of probes behind the medians, and whether it converged.
TEST(AccuracyTables, bothWaysOfRunning) {
    MeasuredScene measured;
    measured.name = "a room";
    tool::RenderedScene& scene = measured.scene;
    scene.truth.probes.resize(7);
    scene.ddgiField.run = {std::vector<UpdateTimes>(9), {}, ConvergeResult{9, false, 0.031f}};
    scene.realtime.emplace();
    scene.realtime->field.run.updates.resize(300);
    scene.realtime->field.ratio = {0.8, 0.9, 1.1};
    scene.realtime->method.indirectOnly.ratio = {0.65, 0.5, 0.6, 0.7, 40};
    scene.indirectNoiseFloor.flip = 0.0123;
    const std::string text = accuracyTables({measured}, {}, 1);
    EXPECT_THAT(text, HasSubstr("with its guard, `converge` | 9 | no: 3.1 % left | 0.000 | 0.000 | 0.000 | 7 |"));
    EXPECT_THAT(text, HasSubstr("with its guard, `update` | 300 |  | 0.800 | 0.900 | 1.100 | 7 |"));
    EXPECT_THAT(text,
                HasSubstr("field, `update` | 0.0000 | 0.0000 | 0.0000 | 0.0000 | 0.650 | 0.500 | 0.600 | 0.700 |"));
    EXPECT_THAT(text, HasSubstr("*an exact picture* | 0.0000 | 0.0000 | 0.0000 | 0.0123 |"));
}

}  // namespace
}  // namespace probegi::accuracy
