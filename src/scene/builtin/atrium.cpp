#include "scene/builtin/builtin.h"
namespace probegi::builtin {
Result<Scene> makeAtrium(const BuiltinParams& p) {
    return makeTwoRooms(p);
}
}  // namespace probegi::builtin
