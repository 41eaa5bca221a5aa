#pragma once

#include <cstddef>
#include <vector>

namespace probegi::tool {

/// Pieces of work as one progress: each takes a share of the whole that somebody guessed.
class WholeProgress {
public:
    /// Guesses of the pieces' times, in order, >= 0; only their ratios count.
    explicit WholeProgress(std::vector<double> guesses);

    /// The next piece begins; those before it are done.
    void begin();
    /// Share of all that is done when so much of the piece is, 0..1 both. Never falls: a piece of several stages that
    /// each begin at 0 stands still instead.
    double fraction(double ofPiece);

private:
    std::vector<double> m_before;  // share of all pieces before each, and 1
    std::size_t m_begun = 0;
    double m_shown = 0;
};

}  // namespace probegi::tool
