#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "report/html.h"
#include "report/render.h"
#include "report/verdict.h"

namespace probegi::tool {

/// Where a scene's pictures go, and under which name.
struct ReportPlace {
    std::filesystem::path folder;
    std::string prefix;  ///< of the files: PREFIX-none.png ...
    std::string title;
};

/// What can be said of the field on all cameras.
Verdict verdictOf(const RenderedScene& scene);

/// Writes the pictures as PNG and EXR, the maps as PNG, and puts them with the numbers into a section of the page.
/// `filmic`: bright light rolls off in the pictures instead of clipping. Errors: those of writeImage.
Result<ReportScene> describeScene(const RenderedScene& scene, const ReportPlace& place, bool filmic);

/// The same numbers for programs.
nlohmann::json sceneNumbers(const RenderedScene& scene);

/// Colours of the error maps in even steps from 0 to 1, as CSS.
std::vector<std::string> legendColours();

}  // namespace probegi::tool
