#pragma once

#include <span>
#include <string>

#include "probegi/measure.h"

namespace probegi::tool {

/// Input to the verdict: the field against the reference in one camera's view.
struct ViewFacts {
    std::string camera;     ///< its name; empty if there is only one
    ImageDifference field;  ///< of the picture with the field
    ImageDifference exact;  ///< what an exact picture would score against this reference due to its noise
    double referenceSeconds = 0;
    int leaks = 0;         ///< places where the field has light that should not be there
    int places = 1;        ///< in all
    double worstLeak = 1;  ///< light there over the reference's
};

enum class Judgement { matches, differs, noisy, leaks };

struct Verdict {
    Judgement judgement = Judgement::matches;
    std::string sentence;  ///< for readers, with advice if there is any
};

/// One verdict for all views of a scene: that of the worst. A view leaks if over 0.25 % of its places do. That is worse
/// than noise, since leaks are counted only where noise cannot explain them; noise is worse than a difference, which
/// could be noise. A view matches if its light is within 5 % in the whole picture, and within 15 % (plus the
/// reference's own noise) in nine of ten of its parts.
Verdict judge(std::span<const ViewFacts> views);

/// "matches", "differs", "noisy" or "leaks".
const char* nameOf(Judgement judgement);

}  // namespace probegi::tool
