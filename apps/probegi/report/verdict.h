#pragma once

#include <span>
#include <string>

#include "probegi/measure.h"

namespace probegi::tool {

/// What the verdict on a scene is made of: the field against the reference as one camera sees them.
struct ViewFacts {
    std::string camera;     ///< its name; empty: there is only one
    ImageDifference field;  ///< of the picture with the field
    ImageDifference exact;  ///< what an exact picture would score against this reference, for its noise
    double referenceSeconds = 0;
    int leaks = 0;         ///< places where the field has light that is not there
    int places = 1;        ///< in all
    double worstLeak = 1;  ///< light there over the reference's
};

enum class Judgement { matches, differs, noisy, leaks };

struct Verdict {
    Judgement judgement = Judgement::matches;
    std::string sentence;  ///< for people, with what to do where something can be done
};

/// One sentence on all views of a scene: the worst that one of them shows. Leaking is: in over 0.25 % of the places. It
/// is worse than noise, for it is told only where noise cannot explain it; noise is worse than a difference, which
/// could be noise. Matching is: light within 5 % in the whole picture, and within 15 % (and the reference's own noise)
/// in nine of ten of its parts.
Verdict judge(std::span<const ViewFacts> views);

/// "matches", "differs", "noisy" or "leaks".
const char* nameOf(Judgement judgement);

}  // namespace probegi::tool
