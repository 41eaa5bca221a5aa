#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace probegi {

/// Chooses one of many by weight in constant time (Vose 1991, "A Linear Algorithm for Generating Random Numbers with a
/// Given Distribution").
class AliasTable {
public:
    AliasTable() = default;
    /// Weights are finite and >= 0. All zero: the table is empty.
    explicit AliasTable(std::span<const double> weights);

    bool empty() const noexcept { return m_entries.empty(); }
    double totalWeight() const noexcept { return m_total; }
    /// An index, chosen with probability weight / totalWeight. 0 <= u < 1; the table must not be empty.
    std::size_t sample(double u) const noexcept {
        const double scaled = u * double(m_entries.size());
        const auto bin = std::size_t(scaled);
        return scaled - double(bin) < double(m_entries[bin].threshold) ? bin : m_entries[bin].alias;
    }

private:
    struct Entry {
        float threshold = 1.0f;
        std::uint32_t alias = 0;
    };
    std::vector<Entry> m_entries;
    double m_total = 0;
};

}  // namespace probegi
