#include "backend.h"

#include <cstdlib>

#include "console/parse.h"
#include "vulkan_device.h"

namespace probegi::tool {

namespace {

constexpr const char* kDeviceOptions[] = {"--device", "--tracer", "--shader-cache"};

}  // namespace

void addBackendOptions(CLI::App& command, BackendOptions& options) {
    constexpr const char* kGroup = "Backend";
    static const std::map<std::string, BackendKind> kKinds{{"cpu", BackendKind::cpu}, {"vulkan", BackendKind::vulkan}};
    static const std::map<std::string, TracerKind> kTracers{
        {"auto", TracerKind::automatic}, {"bvh", TracerKind::bvh}, {"ray-query", TracerKind::rayQuery}};
    command.add_option("--backend", options.kind, "where the passes run (default: cpu); the light is the same")
        ->type_name("cpu|vulkan")
        ->transform(oneOf(kKinds))
        ->group(kGroup);
    command
        .add_option("--device", options.device,
                    "vulkan: the device, as 'probegi devices' lists them (default: the first GPU)")
        ->type_name("INDEX|NAME")
        ->group(kGroup);
    command
        .add_option("--tracer", options.tracer,
                    "vulkan: how rays find triangles, by ProbeGI's own BVH, by the device's ray query, or by ray query "
                    "where the device has it in hardware (auto, the default)")
        ->type_name("auto|bvh|ray-query")
        ->transform(oneOf(kTracers))
        ->group(kGroup);
    command
        .add_option("--shader-cache", options.shaderCache,
                    "vulkan: where compiled shaders are kept (default: probegi in $XDG_CACHE_HOME, else in ~/.cache)")
        ->type_name("FOLDER")
        ->group(kGroup);
}

void checkBackendOptions(const CLI::App& command, const BackendOptions& options) {
    if (options.kind == BackendKind::vulkan) return;
    for (const char* name : kDeviceOptions)
        if (command.get_option(name)->count() > 0)
            throw CLI::ValidationError(name, "acts on --backend vulkan only, which was not given");
}

Result<std::unique_ptr<Backend>> openBackend(const Context& context, const BackendOptions& options) {
    if (options.kind == BackendKind::cpu) return probegi::openBackend(context);
#if PROBEGI_HAS_VULKAN
    const auto device = openDevice(context, options);
    if (!device) return device.error();
    return vulkan::makeBackend(context, *device, options.tracer);
#else
    return builtWithoutVulkan();
#endif
}

std::filesystem::path shaderCacheFolder(const BackendOptions& options) {
    if (!options.shaderCache.empty()) return options.shaderCache;
    // The XDG base directory specification says to ignore relative paths.
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && std::filesystem::path(cache).is_absolute())
        return std::filesystem::path(cache) / "probegi";
    if (const char* home = std::getenv("HOME"); home && *home)
        return std::filesystem::path(home) / ".cache" / "probegi";
    return {};
}

}  // namespace probegi::tool
