#pragma once

#include <cstddef>
#include <vector>

namespace probegi::tool {

/// Progress over several pieces of work, weighted by estimates of their times.
class WholeProgress {
public:
    /// Estimated times of the pieces, in order, >= 0; only their ratios matter.
    explicit WholeProgress(std::vector<double> guesses);

    /// Starts the next piece; those before it are done.
    void begin();
    /// Fraction of the whole that is done when `ofPiece` of the current piece is, both 0..1. Never decreases: if a
    /// piece has several stages, each starting at 0, it stays where it was.
    double fraction(double ofPiece);

private:
    std::vector<double> m_before;  // share of the whole before each piece; ends with 1
    std::size_t m_begun = 0;
    double m_shown = 0;
};

}  // namespace probegi::tool
