#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "report/html.h"
#include "report/render.h"
#include "report/verdict.h"

namespace probegi::tool {

/// The folder and the names of a scene's pictures.
struct ReportPlace {
    std::filesystem::path folder;
    std::string prefix;  ///< of the files: PREFIX-none.png ...
    std::string title;
};

/// The verdict on the field over all cameras.
Verdict verdictOf(const RenderedScene& scene);

/// Writes the pictures as PNG and EXR and the maps as PNG, and makes a section of the page from them and the numbers.
/// `filmic`: bright light rolls off in the pictures instead of clipping. Errors: those of writeImage.
Result<ReportScene> describeScene(const RenderedScene& scene, const ReportPlace& place, bool filmic);

/// The same numbers as JSON.
nlohmann::json sceneNumbers(const RenderedScene& scene);

/// Colours of the error maps in even steps from 0 to 1, as CSS.
std::vector<std::string> legendColours();

}  // namespace probegi::tool
