#include "console/vector_json.h"

#include <fmt/format.h>

namespace probegi::tool {

nlohmann::ordered_json toJson(glm::vec3 v) {
    return {v.x, v.y, v.z};
}

nlohmann::ordered_json toJson(glm::ivec3 v) {
    return {v.x, v.y, v.z};
}

std::string vectorText(const nlohmann::ordered_json& v) {
    return fmt::format("({:.5g}, {:.5g}, {:.5g})", v[0].get<float>(), v[1].get<float>(), v[2].get<float>());
}

}  // namespace probegi::tool
