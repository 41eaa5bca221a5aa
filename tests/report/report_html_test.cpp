#include "report_html.h"

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
    for (const char* id : {"none", "leaky", "ddgi", "reference"})
        scene.pictures.push_back({id, std::string("title ") + id, evil, evil, "png"});
    scene.errorMaps.push_back({"flip", "Error", evil, evil, "png"});
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

TEST(EscapeHtml, leavesNothingThatEndsTextOrAttribute) {
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
    EXPECT_EQ(occurrences(html, "src=\"data:image/png;base64,cG5n\""), 10u);
    EXPECT_EQ(occurrences(html, "src="), 10u);
    EXPECT_THAT(html, Not(HasSubstr("http:")));
    EXPECT_THAT(html, Not(HasSubstr("https:")));
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

TEST(ReportHtml, slidersBeginWithWhatMatters) {
    const std::string html = reportHtml(hostileReport());
    EXPECT_EQ(occurrences(html, "class=\"slider\""), 4u) << "two a scene";
    EXPECT_THAT(html, HasSubstr("<option value=\"s0-none\" selected>"));
    EXPECT_THAT(html, HasSubstr("<option value=\"s1-reference\" selected>"));
}

TEST(ReportHtml, emptyReportIsStillAPage) {
    const std::string html = reportHtml({"nothing", "", {}, {}});
    EXPECT_THAT(html, HasSubstr("<title>nothing</title>"));
    EXPECT_THAT(html, HasSubstr("</html>"));
}

}  // namespace
}  // namespace probegi::tool
