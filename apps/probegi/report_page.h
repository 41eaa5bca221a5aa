#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "report_html.h"
#include "report_render.h"

namespace probegi::tool {

/// Where a scene's pictures go, and under which name.
struct ReportPlace {
    std::filesystem::path folder;
    std::string prefix;  ///< of the files: PREFIX-none.png ...
    std::string title;
};

/// Writes the pictures as PNG and EXR, the error maps as PNG, and puts them with the numbers into a section of the
/// page. Errors: those of writeImage.
Result<ReportScene> describeScene(const RenderedScene& scene, const ReportPlace& place, const ToneMap& display);

/// The same numbers for programs.
nlohmann::json sceneNumbers(const RenderedScene& scene);

/// Colours of the error maps in even steps from 0 to 1, as CSS.
std::vector<std::string> legendColours();

}  // namespace probegi::tool
