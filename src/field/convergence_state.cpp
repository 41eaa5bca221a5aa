#include <bit>

#include "field/convergence.h"
#include "field/layout.h"

namespace probegi {

namespace {

constexpr std::uint32_t kMark = 0x43'4f'4e'31;  // of this list of members
constexpr double kMostAhead = 1e3;              // a closed room of albedo 0.99 is a hundred updates behind
constexpr std::size_t kRegionWords = 8;         // of a region without probes

class Words {
public:
    explicit Words(std::vector<std::uint32_t>& words) : m_words(words) { m_words.clear(); }

    void add(std::uint32_t word) { m_words.push_back(word); }
    void add(int number) { add(std::uint32_t(number)); }
    void add(bool flag) { add(flag ? 1u : 0u); }
    void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
    void add(double number) {
        const auto bits = std::bit_cast<std::uint64_t>(number);
        add(std::uint32_t(bits));
        add(std::uint32_t(bits >> 32));
    }
    template <class T>
    void add(const std::vector<T>& list) {
        add(std::uint32_t(list.size()));
        for (const T& entry : list) add(entry);
    }

private:
    std::vector<std::uint32_t>& m_words;
};

/// Reads what Words wrote. Beyond the end all is 0, and ok() is false.
class WordReader {
public:
    explicit WordReader(std::span<const std::uint32_t> words) : m_words(words) {}

    bool ok() const noexcept { return m_ok; }
    bool atEnd() const noexcept { return m_ok && m_words.empty(); }

    void take(std::uint32_t& word) {
        m_ok = m_ok && !m_words.empty();
        word = m_ok ? m_words.front() : 0u;
        if (m_ok) m_words = m_words.subspan(1);
    }
    void take(int& number) {
        std::uint32_t word;
        take(word);
        number = int(word);
    }
    void take(bool& flag) {
        std::uint32_t word;
        take(word);
        flag = word != 0;
    }
    void take(float& number) {
        std::uint32_t word;
        take(word);
        number = std::bit_cast<float>(word);
    }
    void take(double& number) {
        std::uint32_t low, high;
        take(low);
        take(high);
        number = std::bit_cast<double>(std::uint64_t(high) << 32 | low);
    }
    template <class T>
    void take(std::vector<T>& list) {
        list.resize(count(sizeof(T) / sizeof(std::uint32_t)));
        for (T& entry : list) take(entry);
    }
    /// Of entries that follow, each `wordsEach` or more: what is kept of them is in proportion to the words.
    std::size_t count(std::size_t wordsEach) {
        std::uint32_t word;
        take(word);
        m_ok = m_ok && word <= m_words.size() / wordsEach;
        return m_ok ? word : 0;
    }

private:
    std::span<const std::uint32_t> m_words;
    bool m_ok = true;
};

/// The members that are numbers, in the order of the words.
template <class Self, class Each>
void forNumbers(Self& self, const Each& each) {
    each(self.updates), each(self.turned), each(self.averaged), each(self.differences);
    each(self.ahead), each(self.rate), each(self.slowest), each(self.missing);
    each(self.followed), each(self.converged), each(self.remaining);
}

}  // namespace

void Convergence::save(std::vector<std::uint32_t>& state) const {
    Words words(state);
    words.add(kMark);
    forNumbers(m_now, [&](const auto& number) { words.add(number); });
    words.add(m_common);
    words.add(m_last);
    words.add(m_before);
    words.add(std::uint32_t(m_regions.size()));
    for (const Region& region : m_regions) {
        words.add(region.residual2);
        words.add(region.change);
        words.add(region.earlier);
        words.add(region.counting);
        words.add(region.probes);
    }
}

bool Convergence::restore(std::span<const std::uint32_t> state) {
    WordReader words(state);
    std::uint32_t mark;
    words.take(mark);
    if (mark != kMark) return false;
    forNumbers(m_now, [&](auto& number) { words.take(number); });
    words.take(m_common);
    words.take(m_last);
    words.take(m_before);
    m_regions.resize(words.count(kRegionWords));
    for (Region& region : m_regions) {
        words.take(region.residual2);
        words.take(region.change);
        words.take(region.earlier);
        words.take(region.counting);
        words.take(region.probes);
    }
    return words.atEnd() && isSound();
}

// What would make a later update read beyond an array, or never end.
bool Convergence::isSound() const noexcept {
    std::size_t probes = 0;
    for (const kernels::Volume& volume : m_volumes) probes += std::size_t(kernels::volumeProbes(volume));
    const auto perProbe = [&](const std::vector<float>& list) { return list.empty() || list.size() == probes; };
    if (!perProbe(m_last) || !perProbe(m_before) || (m_last.empty() && (!m_before.empty() || !m_regions.empty())))
        return false;
    for (const Region& region : m_regions)
        for (const int probe : region.probes)
            if (probe < 0 || std::size_t(probe) >= probes) return false;
    const Numbers& n = m_now;
    const bool counted = n.updates >= 0 && n.turned >= 0 && n.turned <= kTurnedUpdates && n.averaged >= 0 &&
                         n.averaged <= n.updates && (n.averaged == 0 || n.turned > 0) && n.differences >= -1 &&
                         n.differences <= n.updates;
    // At most three updates of an average go by without being looked at.
    const bool observed = m_common.size() <= std::size_t(n.updates) && m_common.size() + 3 >= std::size_t(n.averaged);
    return counted && observed && n.ahead >= 0 && n.ahead <= kMostAhead && n.rate >= 0 && n.rate < 1 &&
           n.slowest >= 0 && n.slowest <= kMostAhead && n.missing >= 0 && n.remaining >= 0;
}

}  // namespace probegi
