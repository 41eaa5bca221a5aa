#include "commands.h"

namespace probegi::tool {

void addBenchCommand(CLI::App& app, int&) {
    app.add_subcommand("bench", "measure updates, queries and pictures against raw ray tracing");
}

}  // namespace probegi::tool
