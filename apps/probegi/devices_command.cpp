#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "console/output.h"
#include "console/terminal.h"
#include "console/text_table.h"
#include "vulkan_device.h"

namespace probegi::tool {

namespace {

const char* const kFooter =
    R"(Give the index, or a part of the name, to --device: probegi render SCENE -o a.png --backend vulkan --device 0

Example: probegi devices)";

#if PROBEGI_HAS_VULKAN

std::string usableText(const vulkan::DeviceInfo& device) {
    return device.usable() ? "yes" : "no, lacks " + device.missing;
}

void printTable(const std::vector<vulkan::DeviceInfo>& devices) {
    std::vector<std::vector<std::string>> cells{{"index", "name", "type", "driver", "Vulkan", "ray query", "usable"}};
    for (const vulkan::DeviceInfo& device : devices)
        cells.push_back({std::to_string(device.index), plainText(device.name, kShownName), device.type,
                         plainText(device.driver, kShownName), device.api, device.rayQuery ? "yes" : "no",
                         usableText(device)});
    fmt::print("{}", markdownTable(cells));
}

void printJson(const std::vector<vulkan::DeviceInfo>& devices) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const vulkan::DeviceInfo& device : devices)
        json.push_back({{"index", device.index},
                        {"name", device.name},
                        {"type", device.type},
                        {"driver", device.driver},
                        {"vulkan", device.api},
                        {"rayQuery", device.rayQuery},
                        {"usable", device.usable()},
                        {"missing", device.missing}});
    fmt::print("{}", jsonText(json));
}

Result<void> listDevices(bool json) {
    const auto devices = vulkan::listDevices();
    if (!devices) return devices.error();
    if (devices->empty() && !json)
        return fail(ErrorCode::unsupported,
                    "no Vulkan driver found a device; install a driver (mesa-vulkan-drivers has a software one)");
    json ? printJson(*devices) : printTable(*devices);
    return {};
}

#else

Result<void> listDevices(bool) {
    return builtWithoutVulkan();
}

#endif

}  // namespace

void addDevicesCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand("devices", "list the Vulkan devices that --backend vulkan can use");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "print JSON");
    command->footer(kFooter);
    command->callback([json, &exitCode] {
        if (const auto done = listDevices(*json); !done) exitCode = printError(done.error());
    });
}

}  // namespace probegi::tool
