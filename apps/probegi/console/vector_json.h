#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace probegi::tool {

/// [x, y, z].
nlohmann::ordered_json toJson(glm::vec3 v);
nlohmann::ordered_json toJson(glm::ivec3 v);

/// "(1, 2.5, 0)" of such a list.
std::string vectorText(const nlohmann::ordered_json& v);

}  // namespace probegi::tool
