#pragma once

#include "report/html.h"
#include "report/render.h"

namespace probegi::tool {

/// The numbers of one scene as text.
std::vector<ReportTable> reportTables(const RenderedScene& scene);
std::vector<ReportFigure> reportFigures(const RenderedScene& scene);
std::string reportSummary(const RenderedScene& scene);

/// 1234567 as 1,234,567.
std::string grouped(std::size_t number);

}  // namespace probegi::tool
