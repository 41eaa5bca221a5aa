#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "leak.h"
#include "report/render.h"

namespace probegi::accuracy {

struct MeasuredScene {
    std::string name;
    tool::RenderedScene scene;
};

/// The generated part of docs/accuracy.md.
std::string accuracyTables(const std::vector<MeasuredScene>& scenes, const std::vector<LeakResult>& leaks, int threads);

/// Replaces what is between the two marker lines of an existing file by `tables`.
/// Errors: fileUnreadable (no such file), malformed (no markers), writeFailed.
Result<void> replaceBetweenMarkers(const std::filesystem::path& path, const std::string& tables);

}  // namespace probegi::accuracy
