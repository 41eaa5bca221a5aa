#include "console/whole_progress.h"

#include <algorithm>
#include <numeric>

namespace probegi::tool {

WholeProgress::WholeProgress(std::vector<double> guesses) : m_before(guesses.size() + 1, 0.0) {
    std::partial_sum(guesses.begin(), guesses.end(), m_before.begin() + 1);
    const double all = m_before.back();
    for (double& before : m_before) before = all > 0 ? before / all : 0;
}

void WholeProgress::begin() {
    m_begun = std::min(m_begun + 1, m_before.size() - 1);
}

double WholeProgress::fraction(double ofPiece) {
    if (m_begun == 0) return 0;
    const double first = m_before[m_begun - 1], last = m_before[m_begun];
    m_shown = std::max(m_shown, first + (last - first) * std::clamp(ofPiece, 0.0, 1.0));
    return m_shown;
}

}  // namespace probegi::tool
