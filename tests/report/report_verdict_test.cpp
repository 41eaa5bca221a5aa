#include "report/verdict.h"

#include <gmock/gmock.h>

namespace probegi::tool {
namespace {

using testing::HasSubstr;
using testing::Not;

ViewFacts good(const char* camera = "") {
    ViewFacts view;
    view.camera = camera;
    view.field.flip = 0.03;
    view.field.ratio = {1.01, 0.92, 1.0, 1.08, 40};
    view.exact.flip = 0.01;
    view.exact.ratio = {1, 0.99, 1, 1.01, 40};
    view.referenceSeconds = 45;
    view.places = 1000;
    return view;
}

Verdict of(const ViewFacts& view) {
    return judge(std::span(&view, 1));
}

TEST(Verdict, Matches) {
    const Verdict verdict = of(good());
    EXPECT_EQ(verdict.judgement, Judgement::matches);
    EXPECT_THAT(verdict.sentence, HasSubstr("Matches: the picture has 1.010 times"));
    EXPECT_THAT(verdict.sentence, HasSubstr("0.92 to 1.08"));
    EXPECT_THAT(verdict.sentence, Not(HasSubstr("camera")));
}

TEST(Verdict, DiffersInTheMeanOrInParts) {
    for (const LightRatio ratio : {LightRatio{1.06, 0.95, 1, 1.05, 40}, LightRatio{0.94, 0.95, 1, 1.05, 40},
                                   LightRatio{1, 0.8, 1, 1.05, 40}, LightRatio{1, 0.95, 1, 1.2, 40}}) {
        ViewFacts view = good();
        view.field.ratio = ratio;
        EXPECT_EQ(of(view).judgement, Judgement::differs) << ratio.mean << " " << ratio.low << " " << ratio.high;
        EXPECT_THAT(of(view).sentence, testing::StartsWith("Differs"));
    }
}

TEST(Verdict, PartsMayBeOffByTheReferencesOwnNoise) {
    ViewFacts view = good();
    view.field.ratio.high = 1.2;
    view.exact.ratio.high = 1.06;
    EXPECT_EQ(of(view).judgement, Judgement::matches);
}

TEST(Verdict, TooNoisyRecommendsATime) {
    ViewFacts view = good();
    view.exact.flip = 0.1;
    view.field.flip = 0.12;
    const Verdict verdict = of(view);
    EXPECT_EQ(verdict.judgement, Judgement::noisy);
    // Four times too noisy: sixteen times the time, 720 s, rounded up.
    EXPECT_THAT(verdict.sentence, HasSubstr("--time 1000"));
    view.referenceSeconds = 12;
    EXPECT_THAT(of(view).sentence, HasSubstr("--time 200"));
    view.field.flip = 0.5;  // the field's error is far above the noise
    EXPECT_NE(of(view).judgement, Judgement::noisy);
}

TEST(Verdict, LeaksComeFirst) {
    ViewFacts view = good();
    view.exact.flip = 0.1;
    view.leaks = 3;
    view.worstLeak = 4.26;
    const Verdict verdict = of(view);
    EXPECT_EQ(verdict.judgement, Judgement::leaks);
    EXPECT_THAT(verdict.sentence, HasSubstr("Leaks here: 3 of 1000 places"));
    EXPECT_THAT(verdict.sentence, HasSubstr("up to 4.3 times"));
    view.worstLeak = 1000;  // where there should be no light
    EXPECT_THAT(of(view).sentence, HasSubstr("over 100 times"));
    view.exact.flip = 0.01;
    view.leaks = 2;  // too few to matter
    EXPECT_EQ(of(view).judgement, Judgement::matches);
}

TEST(Verdict, TheWorstOfAllCameras) {
    ViewFacts leaking = good("cellar"), worse = good("attic"), off = good("hall");
    leaking.leaks = 4;
    worse.leaks = 9;
    off.field.ratio.mean = 3;
    const ViewFacts views[] = {good("door"), leaking, worse, off};
    EXPECT_EQ(judge(views).judgement, Judgement::leaks);
    EXPECT_THAT(judge(views).sentence, HasSubstr("(camera attic)"));
    EXPECT_THAT(judge(std::span(views, 1)).sentence, HasSubstr("(camera door)"));
}

TEST(Verdict, BlackIsBlack) {
    ViewFacts view = good();
    view.field.ratio = {};
    EXPECT_EQ(of(view).judgement, Judgement::matches);
    EXPECT_THAT(of(view).sentence, HasSubstr("both are black"));
}

}  // namespace
}  // namespace probegi::tool
