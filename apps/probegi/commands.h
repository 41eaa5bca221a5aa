#pragma once

#include <CLI/CLI.hpp>

namespace probegi::tool {

// One function per command, each in its own file. A command sets `exitCode`: 0, or 1 after a failure.
void addRenderCommand(CLI::App& app, int& exitCode);
void addBakeCommand(CLI::App& app, int& exitCode);
void addCompareCommand(CLI::App& app, int& exitCode);
void addInfoCommand(CLI::App& app, int& exitCode);
void addScenesCommand(CLI::App& app, int& exitCode);
void addDevicesCommand(CLI::App& app, int& exitCode);
void addBenchCommand(CLI::App& app, int& exitCode);
void addReportCommand(CLI::App& app, int& exitCode);
void addAuditCommand(CLI::App& app, int& exitCode);
void addFitCommand(CLI::App& app, int& exitCode);

}  // namespace probegi::tool
