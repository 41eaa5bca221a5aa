#include "reference/alias_table.h"

namespace probegi {

AliasTable::AliasTable(std::span<const double> weights) {
    for (const double weight : weights) m_total += weight;
    if (!(m_total > 0)) return;
    m_entries.resize(weights.size());
    const double perBin = m_total / double(weights.size());
    std::vector<double> share(weights.size());
    std::vector<std::uint32_t> poor, rich;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        share[i] = weights[i] / perBin;
        m_entries[i].alias = std::uint32_t(i);
        (share[i] < 1 ? poor : rich).push_back(std::uint32_t(i));
    }
    // Fill every poor bin from a rich one. Bins left over are full up to rounding.
    while (!poor.empty() && !rich.empty()) {
        const std::uint32_t taker = poor.back(), giver = rich.back();
        poor.pop_back();
        m_entries[taker] = {float(share[taker]), giver};
        share[giver] -= 1 - share[taker];
        if (share[giver] >= 1) continue;
        rich.pop_back();
        poor.push_back(giver);
    }
}

}  // namespace probegi
