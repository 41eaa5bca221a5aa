#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/rounds.h"

namespace probegi::tool {

/// One line of the report. A line without a goal is for information.
struct BenchRow {
    std::string key;      ///< for JSON
    std::string name;     ///< what is measured
    std::string figure;   ///< with its unit
    std::string against;  ///< what the ratio is relative to; empty: no ratio
    std::optional<double> ratio;
    std::optional<double> goal;
    bool atLeast = false;  ///< the goal is a lower bound
    std::string papers;    ///< the papers' figures for the same work

    std::string verdict() const;  ///< pass, miss, or nothing without a goal
};

std::vector<BenchRow> benchRows(const BenchResult& result);

/// Exponent of the growth between the smallest and the largest volume with the same rays per probe; 1 is linear.
double growthExponent(const std::vector<BenchGrowth>& growth);

/// The tables as Markdown, aligned so that they can be read in a terminal too.
std::string benchMarkdown(const BenchResult& result, const std::string& sceneName);

std::string benchJson(const BenchResult& result, const std::string& sceneName);

}  // namespace probegi::tool
