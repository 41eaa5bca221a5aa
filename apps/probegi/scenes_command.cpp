#include <fmt/format.h>

#include "commands.h"
#include "probegi/builtin_scenes.h"

namespace probegi::tool {

void addScenesCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("scenes", "list the built-in scenes, which need no file");
    command->footer("Example: probegi scenes\nEach is accepted wherever a SCENE is: probegi info builtin:cornell");
    command->callback([] {
        for (const BuiltinScene& scene : builtinScenes()) fmt::print("{:<12} {}\n", scene.name, scene.description);
    });
}

}  // namespace probegi::tool
