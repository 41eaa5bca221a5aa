#include "backend.h"

#include <cstdlib>

#include "console/parse.h"
#include "vulkan_backend.h"

namespace probegi::tool {

namespace {

constexpr const char* kDeviceOptions[] = {"--device", "--tracer", "--shader-cache"};

class CpuBackend final : public Backend {
public:
    explicit CpuBackend(Context context) : m_context(std::move(context)) {}

    BackendKind kind() const noexcept override { return BackendKind::cpu; }
    Result<std::unique_ptr<Tracer>> makeTracer(const Scene& scene, const ScenePose& pose) const override {
        return makeEmbreeTracer(m_context, scene, pose);
    }
    Result<Field> makeField(const FieldDesc& desc, const FieldSettings& settings) const override {
        return Field::create(m_context, desc, settings);
    }
    Result<RenderedPicture> render(const Tracer& tracer, const Lighting& lighting, const Field* field,
                                   const PictureDesc& desc) const override {
        return renderPicture(m_context, tracer, lighting, field, desc);
    }

private:
    Context m_context;
};

}  // namespace

void addBackendOptions(CLI::App& command, BackendOptions& options) {
    constexpr const char* kGroup = "Backend";
    static const std::map<std::string, BackendKind> kKinds{{"cpu", BackendKind::cpu}, {"vulkan", BackendKind::vulkan}};
    static const std::map<std::string, GpuTracer> kTracers{
        {"auto", GpuTracer::automatic}, {"bvh", GpuTracer::bvh}, {"ray-query", GpuTracer::rayQuery}};
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
    if (options.kind == BackendKind::vulkan) return openVulkanBackend(context, options);
    return std::make_unique<CpuBackend>(context);
}

std::filesystem::path shaderCacheFolder(const BackendOptions& options) {
    if (!options.shaderCache.empty()) return options.shaderCache;
    // The XDG base directory specification: relative paths are to be ignored.
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && std::filesystem::path(cache).is_absolute())
        return std::filesystem::path(cache) / "probegi";
    if (const char* home = std::getenv("HOME"); home && *home)
        return std::filesystem::path(home) / ".cache" / "probegi";
    return {};
}

}  // namespace probegi::tool
