#include "report/html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace probegi::tool {
namespace {

using testing::HasSubstr;
using testing::Not;

Report hostileReport() {
    const std::string evil = "<script>alert('x')</script>\"&";
    ReportScene scene;
    scene.title = evil;
    scene.summary = evil;
    scene.figures = {{evil, evil}};
    scene.verdict = scene.judgement = evil;
    ReportView view;
    view.title = evil;
    for (const char* id : {"none", "leaky", "ddgi", "reference"})
        view.pictures.push_back({id, std::string("title ") + id, evil, evil, "png", "values", evil, true, evil});
    view.maps.push_back({"flip", "Error", evil, evil, "png"});
    scene.views = {view, view};
    scene.probes = {view.maps[0]};
    scene.probeKey = {{evil, evil}};
    scene.tables = {{evil, {"", evil}, {{evil, evil}}, evil}};
    return {evil, evil, {"#000000", "#ffffff"}, {scene, scene}};
}

std::size_t occurrences(const std::string& text, std::string_view part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(Base64, vectorsOfRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, allBits) {
    EXPECT_EQ(base64(std::string("\xff\xff\xff\x00\x10\x83", 6)), "////ABCD");
}

TEST(EscapeHtml, leavesNothingThatEndsATextOrAnAttribute) {
    EXPECT_EQ(escapeHtml("a<b>&\"c\"'"), "a&lt;b&gt;&amp;&quot;c&quot;&#39;");
    EXPECT_EQ(escapeHtml("plain, 1 x 2"), "plain, 1 x 2");
}

TEST(ReportHtml, escapesEveryTextThatItIsGiven) {
    const std::string html = reportHtml(hostileReport());
    EXPECT_THAT(html, Not(HasSubstr("alert('x')")));
    EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(&#39;x&#39;)"));
}

TEST(ReportHtml, holdsEachPictureOnceAndAsksForNothing) {
    const std::string html = reportHtml(hostileReport());
    EXPECT_EQ(occurrences(html, "src=\"data:image/png;base64,cG5n\""), 22u)
        << "two scenes, two views of five, and the probes";
    EXPECT_EQ(occurrences(html, "src="), 22u);
    EXPECT_EQ(occurrences(html, "data-values=\"data:image/png;base64,dmFsdWVz\""), 16u);
    EXPECT_THAT(html, Not(HasSubstr("http:")));
    EXPECT_THAT(html, Not(HasSubstr("https:")));
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

TEST(ReportHtml, slidersBeginWithWhatMatters) {
    const std::string html = reportHtml(hostileReport());
    EXPECT_EQ(occurrences(html, "class=\"slider\""), 8u) << "two a view";
    EXPECT_THAT(html, HasSubstr("<option value=\"s0v0-none\" selected>"));
    EXPECT_THAT(html, HasSubstr("<option value=\"s1v1-reference\" selected>"));
}

TEST(ReportHtml, theVerdictComesFirst) {
    Report report = hostileReport();
    report.scenes[0].verdict = "Matches: so it does.";
    report.scenes[0].judgement = "matches";
    const std::string html = reportHtml(report);
    const std::size_t verdict = html.find("<p class=\"verdict matches\">Matches: so it does.</p>");
    ASSERT_NE(verdict, std::string::npos);
    EXPECT_LT(verdict, html.find("<img"));
    EXPECT_LT(verdict, html.find("class=\"tiles\""));
}

TEST(ReportHtml, linksToTheExrBesideThePage) {
    Report report = hostileReport();
    report.scenes[0].views[0].pictures[0].exr = "room-none.exr";
    EXPECT_THAT(reportHtml(report), HasSubstr("<a href=\"room-none.exr\" download>room-none.exr</a>"));
}

TEST(ReportHtml, emptyReportIsStillAPage) {
    const std::string html = reportHtml({"nothing", "", {}, {}});
    EXPECT_THAT(html, HasSubstr("<title>nothing</title>"));
    EXPECT_THAT(html, HasSubstr("</html>"));
}

}  // namespace
}  // namespace probegi::tool
