#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "probegi/audit.h"

namespace probegi::tool {

/// What is told of a place that leaks, in plain sentences.
struct PlaceText {
    std::string title;   ///< what happens
    std::string where;   ///< position in the scene's own coordinates, and size
    std::string why;     ///< the cause
    std::string remedy;  ///< what helps, with numbers
};

/// `origin`: Scene::origin, by which the scene was moved.
PlaceText describe(const LeakPlace& place, glm::vec3 origin);

/// "1.2 m", "4 cm", "0.7 mm".
std::string metres(double length);

/// The name of a cause in JSON: "thinWall" and so on.
const char* nameOf(LeakCause cause);

/// One sentence on what was tested and found.
std::string auditSummary(const LeakAudit& audit, const AuditDesc& desc);

/// All of an audit as JSON.
nlohmann::ordered_json auditJson(const LeakAudit& audit, const AuditDesc& desc, glm::vec3 origin);

}  // namespace probegi::tool
