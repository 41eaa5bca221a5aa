#include "vulkan_backend.h"

#include <fmt/format.h>

namespace probegi::tool {

Error builtWithoutVulkan() {
    return {ErrorCode::unsupported,
            "this probegi was built without its Vulkan backend (PROBEGI_VULKAN is OFF); only --backend cpu is there"};
}

#if PROBEGI_HAS_VULKAN

namespace {

class VulkanBackend final : public Backend {
public:
    VulkanBackend(Context context, vulkan::Device device, vulkan::TracerKind tracer)
        : m_context(std::move(context)), m_device(std::move(device)), m_tracer(tracer) {}

    BackendKind kind() const noexcept override { return BackendKind::vulkan; }
    Result<std::unique_ptr<Tracer>> makeTracer(const Scene& scene, const ScenePose& pose) const override {
        vulkan::GpuSceneDesc desc;
        desc.tracer = m_tracer;
        return vulkan::makeTracer(m_context, m_device, scene, pose, desc);
    }
    Result<Field> makeField(const FieldDesc& desc, const FieldSettings& settings) const override {
        return vulkan::makeField(m_context, m_device, desc, settings);
    }
    Result<RenderedPicture> render(const Tracer& tracer, const Lighting& lighting, const Field* field,
                                   const PictureDesc& desc) const override {
        return vulkan::renderPicture(m_context, m_device, tracer, lighting, field, desc);
    }

private:
    Context m_context;
    vulkan::Device m_device;
    vulkan::TracerKind m_tracer;
};

}  // namespace

vulkan::TracerKind tracerKind(GpuTracer tracer) noexcept {
    if (tracer == GpuTracer::bvh) return vulkan::TracerKind::bvh;
    return tracer == GpuTracer::rayQuery ? vulkan::TracerKind::rayQuery : vulkan::TracerKind::automatic;
}

Result<vulkan::Device> openDevice(const Context& context, const BackendOptions& options) {
    vulkan::OpenDesc desc;
    desc.device = options.device;
    desc.cacheFolder = shaderCacheFolder(options);
    auto device = vulkan::Device::open(context, desc);
    if (device && options.tracer == GpuTracer::rayQuery && !device->rayQuery())
        return fail(ErrorCode::unsupported,
                    fmt::format("the Vulkan device '{}' has no ray query; use --tracer bvh, or another --device",
                                device->info().name));
    return device;
}

Result<std::unique_ptr<Backend>> openVulkanBackend(const Context& context, const BackendOptions& options) {
    auto device = openDevice(context, options);
    if (!device) return device.error();
    return std::make_unique<VulkanBackend>(context, std::move(*device), tracerKind(options.tracer));
}

#else

Result<std::unique_ptr<Backend>> openVulkanBackend(const Context&, const BackendOptions&) {
    return builtWithoutVulkan();
}

#endif

}  // namespace probegi::tool
