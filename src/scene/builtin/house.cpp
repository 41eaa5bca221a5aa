#include "scene/builtin/builtin.h"
namespace probegi::builtin {
Result<Scene> makeHouse(const BuiltinParams& p) {
    return makeTwoRooms(p);
}
}  // namespace probegi::builtin
