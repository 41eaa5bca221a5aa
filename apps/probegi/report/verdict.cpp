#include "report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace probegi::tool {

namespace {

constexpr double kLeakShare = 0.0025;  // of the places: a few leaves do not reach it
constexpr double kMeanWithin = 0.05, kPartsWithin = 0.15;
// FLIP of an exact picture above which the reference is too noisy to judge by, and what a better reference should
// reach.
constexpr double kNoisyFlip = 0.05, kGoodFlip = 0.025;

bool tooNoisy(const ViewFacts& view) {
    return view.exact.flip > kNoisyFlip && view.exact.flip > 0.5 * view.field.flip;
}

bool matches(const ViewFacts& view) {
    const LightRatio &ratio = view.field.ratio, &exact = view.exact.ratio;
    if (ratio.blocks == 0) return true;  // both are black
    return std::abs(ratio.mean - 1) <= kMeanWithin && ratio.low >= std::min(exact.low, 1.0) - kPartsWithin &&
           ratio.high <= std::max(exact.high, 1.0) + kPartsWithin;
}

Judgement judgementOf(const ViewFacts& view) {
    if (view.leaks > kLeakShare * view.places) return Judgement::leaks;
    if (tooNoisy(view)) return Judgement::noisy;
    return matches(view) ? Judgement::matches : Judgement::differs;
}

/// Orders views of the same judgement.
double severity(const ViewFacts& view, Judgement judgement) {
    switch (judgement) {
        case Judgement::leaks:
            return double(view.leaks) / view.places;
        case Judgement::noisy:
            return view.exact.flip;
        case Judgement::differs:
        case Judgement::matches:
            break;
    }
    const LightRatio& ratio = view.field.ratio;
    return std::max({std::abs(ratio.mean - 1), 1 - ratio.low, ratio.high - 1});
}

/// Seconds after which the noise should be good enough: it falls with the square root of time. Rounded up to 1, 2, 3 or
/// 5 times a power of ten.
int enoughSeconds(const ViewFacts& view) {
    const double wanted = std::max(view.referenceSeconds, 1.0) * std::pow(view.exact.flip / kGoodFlip, 2);
    for (double decade = 1;; decade *= 10)
        for (const int digit : {1, 2, 3, 5})
            if (digit * decade >= wanted) return int(digit * decade);
}

std::string in(const ViewFacts& view) {
    return view.camera.empty() ? std::string() : fmt::format(" (camera {})", view.camera);
}

std::string timesText(double factor) {
    return factor > 99 ? "over 100 times" : fmt::format("up to {:.2g} times", factor);
}

std::string sentenceOf(const ViewFacts& view, Judgement judgement) {
    const LightRatio& ratio = view.field.ratio;
    switch (judgement) {
        case Judgement::leaks:
            return fmt::format(
                "Leaks here{}: {} of {} places in the picture have {} the light that is there; the "
                "leak "
                "map marks them in red.",
                in(view), view.leaks, view.places, timesText(view.worstLeak));
        case Judgement::noisy:
            return fmt::format(
                "Reference too noisy{}: an exact picture would score {:.3f} of the field's {:.3f} (FLIP); make it "
                "again with --time {}.",
                in(view), view.exact.flip, view.field.flip, enoughSeconds(view));
        case Judgement::differs:
            return fmt::format(
                "Differs{}: the picture has {:.3f} times the reference's light, its parts {:.2f} to {:.2f} times.",
                in(view), ratio.mean, ratio.low, ratio.high);
        case Judgement::matches:
            break;
    }
    if (ratio.blocks == 0) return fmt::format("Matches{}: both are black.", in(view));
    return fmt::format(
        "Matches{}: the picture has {:.3f} times the reference's light, its parts {:.2f} to {:.2f} times.", in(view),
        ratio.mean, ratio.low, ratio.high);
}

}  // namespace

Verdict judge(std::span<const ViewFacts> views) {
    if (views.empty()) return {};
    const auto worst = std::max_element(views.begin(), views.end(), [](const ViewFacts& a, const ViewFacts& b) {
        const Judgement ja = judgementOf(a), jb = judgementOf(b);
        return ja != jb ? ja < jb : severity(a, ja) < severity(b, jb);
    });
    const Judgement judgement = judgementOf(*worst);
    return {judgement, sentenceOf(*worst, judgement)};
}

const char* nameOf(Judgement judgement) {
    switch (judgement) {
        case Judgement::matches:
            return "matches";
        case Judgement::differs:
            return "differs";
        case Judgement::noisy:
            return "noisy";
        case Judgement::leaks:
            break;
    }
    return "leaks";
}

}  // namespace probegi::tool
