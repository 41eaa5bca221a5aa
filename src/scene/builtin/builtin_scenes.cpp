#include "probegi/builtin_scenes.h"

#include <array>
#include <cmath>

#include "core/sentence.h"
#include "scene/builtin/builtin.h"

namespace probegi {

namespace {

struct Entry {
    BuiltinScene scene;
    Result<Scene> (*make)(const BuiltinParams&);
};

constexpr std::array kEntries{
    Entry{{"atrium", "a two-storey colonnade around a sunlit court, with cloth, plants and a fountain"},
          builtin::makeAtrium},
    Entry{{"house", "a furnished two-storey house with coloured rooms, lit by sun and sky through its windows"},
          builtin::makeHouse},
    Entry{{"terrain", "hills with huts and stones under the open sky: a million triangles, most of them instances"},
          builtin::makeTerrain},
    Entry{{"cornell", "the Cornell box: red and green walls, two blocks, a lamp in the ceiling"}, builtin::makeCornell},
    Entry{{"two-rooms", "a sunlit room and a second one that gets its light through the doorway (wallThickness)"},
          builtin::makeTwoRooms},
    Entry{{"dark-room", "a sealed room beside a sunlit one: whatever is bright in it has leaked (wallThickness)"},
          builtin::makeDarkRoom},
    Entry{
        {"door", "a sunlit room and a dark one, and between them a door that opens from second 1 to 3 (wallThickness)"},
        builtin::makeDoor},
    Entry{{"moving", "a closed room in which a lamp, a box and a camera move for four seconds"}, builtin::makeMoving},
    Entry{{"mirrors", "a robot between two mirrors that face each other, and metal balls from polished to rough"},
          builtin::makeMirrors},
    Entry{{"desk", "a cluttered desk by a window, with a lamp: nooks smaller than the cells of its grid"},
          builtin::makeDesk},
    Entry{{"furnace", "a closed glowing box with a known answer everywhere (albedo, emission)"}, builtin::makeFurnace},
    Entry{{"sphere", "an integrating sphere around a point light, with a known answer (albedo, power, radius)"},
          builtin::makeSphere},
};

constexpr auto kScenes = [] {
    std::array<BuiltinScene, kEntries.size()> scenes;
    for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i] = kEntries[i].scene;
    return scenes;
}();

}  // namespace

std::span<const BuiltinScene> builtinScenes() {
    return kScenes;
}

Result<Scene> makeBuiltinScene(std::string_view name, const BuiltinParams& params) {
    std::string known;
    for (const Entry& entry : kEntries) {
        if (entry.scene.name == name) return entry.make(params);
        known += sentence(known.empty() ? "" : ", ", entry.scene.name);
    }
    return fail(ErrorCode::invalidArgument,
                sentence("there is no built-in scene called '", name, "'; the built-in scenes are: ", known));
}

namespace builtin {

Result<void> requireWithin(std::string_view parameter, float value, float lower, float upper) {
    if (value >= lower && value <= upper) return {};
    return fail(ErrorCode::invalidArgument, sentence(parameter, " is ", value, "; it must be ", lower, "..", upper));
}

Result<void> requirePositive(std::string_view parameter, float value) {
    if (std::isfinite(value) && value > 0) return {};
    return fail(ErrorCode::invalidArgument, sentence(parameter, " is ", value, "; it must be finite and > 0"));
}

}  // namespace builtin

}  // namespace probegi
