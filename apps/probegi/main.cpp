#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <system_error>

#include "commands.h"
#include "console/terminal.h"

namespace {

using namespace probegi::tool;

constexpr int kUsageError = 2;

constexpr const char* kFirstSteps = R"(What to type first:
  probegi scenes                                     the scenes that need no file
  probegi render builtin:atrium -o atrium.png        a picture lit by a field of light probes
  probegi render builtin:atrium -o truth.png --method reference --time 20
                                                     the same picture, path traced
  probegi report builtin:atrium -o out               both of them and more, side by side in a web page

Example: probegi render sponza.glb -o sponza.png --sun 0.2,-0.95,0.25,20 --sky 0.3,0.4,0.6
Every command has its own help: probegi render --help)";

// The command whose help to print: the innermost one on the command line.
const CLI::App& chosenCommand(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app : *chosen.front();
}

std::string helpOf(const CLI::App& app) {
    const CLI::App& command = chosenCommand(app);
    return &command == &app ? app.help() : command.help(app.get_name());
}

int usageError(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& command = chosenCommand(app);
    const std::string help = &command == &app ? "probegi --help" : "probegi " + command.get_name() + " --help";
    printError({probegi::ErrorCode::invalidArgument, fmt::format("{} (see '{}')", error.what(), help)});
    return kUsageError;
}

int run(int argc, char** argv) {
    CLI::App app("ProbeGI: real-time global illumination from light probes with visibility", "probegi");
    app.footer(kFirstSteps);
    app.set_version_flag("--version", "probegi " PROBEGI_VERSION);
    app.require_subcommand(0, 1);
    int exitCode = 0;
    addScenesCommand(app, exitCode);
    addRenderCommand(app, exitCode);
    addBakeCommand(app, exitCode);
    addReportCommand(app, exitCode);
    addAuditCommand(app, exitCode);
    addFitCommand(app, exitCode);
    addCompareCommand(app, exitCode);
    addInfoCommand(app, exitCode);
    addDevicesCommand(app, exitCode);
    addBenchCommand(app, exitCode);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        fmt::print("{}", helpOf(app));
        return 0;
    } catch (const CLI::CallForVersion& version) {
        fmt::print("{}\n", version.what());
        return 0;
    } catch (const CLI::ParseError& error) {
        return usageError(app, error);
    }
    if (app.get_subcommands().empty()) fmt::print("{}", app.help());
    return exitCode;
}

}  // namespace

int main(int argc, char** argv) {
    keepStandardStreams();
    int exitCode = 1;
    std::error_code printing;
    try {
        exitCode = run(argc, argv);
    } catch (const std::bad_alloc&) {
        printError({probegi::ErrorCode::outOfMemory, "not enough memory; use a smaller scene, picture or probe grid"});
    } catch (const std::exception& error) {
        const auto* system = dynamic_cast<const std::system_error*>(&error);
        if (std::ferror(stdout) && system)
            printing = system->code();  // closeStandardOutput() reports it
        else
            printError({probegi::ErrorCode::invalidArgument,
                        fmt::format("internal error ({}); please report it", error.what())});
    }
    return closeStandardOutput(exitCode, printing);
}
