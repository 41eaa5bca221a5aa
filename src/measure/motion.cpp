#include <algorithm>
#include <cmath>
#include <numeric>

#include "measure/input_checks.h"
#include "probegi/measure.h"

namespace probegi {

namespace {

constexpr double kDark = 0.01;  // share of the mean light below which a ratio means nothing

double meanOf(std::span<const double> light) {
    return std::accumulate(light.begin(), light.end(), 0.0) / double(light.size());
}

Flicker flickerOf(std::span<const std::vector<double>> updates) {
    const double count = double(updates.size());
    std::vector<double> sum(updates[0].size()), square(sum.size());
    for (const std::vector<double>& light : updates)
        for (std::size_t i = 0; i < light.size(); ++i) {
            sum[i] += light[i];
            square[i] += light[i] * light[i];
        }
    const double least = kDark * meanOf(sum) / count;
    std::vector<double> shares;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double mean = sum[i] / count;
        if (mean > least) shares.push_back(std::sqrt(std::max(0.0, square[i] / count - mean * mean)) / mean);
    }
    if (shares.empty()) return {};
    std::sort(shares.begin(), shares.end());
    return {meanOf(shares), shares[shares.size() * 95 / 100]};
}

}  // namespace

Result<Flicker> measureFlicker(std::span<const std::vector<double>> updates) {
    for (const std::vector<double>& light : updates)
        if (auto ok = checkSameCount("an update", light.size(), updates[0].size()); !ok) return ok.error();
    if (updates.empty() || updates[0].empty()) return Flicker{};
    return withinMemory("measure flicker", [&]() -> Result<Flicker> { return flickerOf(updates); });
}

Result<double> shareLeft(std::span<const double> now, std::span<const double> start, std::span<const double> goal) {
    if (auto ok = checkSameCount("start", start.size(), now.size()); !ok) return ok.error();
    if (auto ok = checkSameCount("goal", goal.size(), now.size()); !ok) return ok.error();
    if (now.empty()) return 0.0;
    const double least = kDark * std::max(meanOf(start), meanOf(goal));
    double left = 0, whole = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double level = std::max({start[i], goal[i], least});
        if (!(level > 0)) continue;
        const double way = (start[i] - goal[i]) / level;
        left += way * (now[i] - goal[i]) / level;
        whole += way * way;
    }
    return whole > 0 ? left / whole : 0.0;
}

}  // namespace probegi
