#include "core/sentence.h"
#include "probegi/vulkan/standalone.h"

namespace probegi::vulkan {

namespace {

class VulkanRenderer final : public PictureRenderer {
public:
    VulkanRenderer(const Context& context, const Device& device) : m_context(context), m_device(device) {}

    Result<RenderedPicture> render(const Tracer& tracer, const Lighting& lighting, const Field* field,
                                   const PictureDesc& desc) override {
        return renderPicture(m_context, m_device, tracer, lighting, field, desc);
    }

private:
    Context m_context;
    Device m_device;
};

class VulkanBackend final : public Backend {
public:
    VulkanBackend(const Context& context, const Device& device, TracerKind tracer)
        : m_context(context), m_device(device), m_tracer(tracer) {}

    BackendKind kind() const noexcept override { return BackendKind::vulkan; }
    Result<std::unique_ptr<Tracer>> openScene(const Scene& scene, const ScenePose& pose) const override {
        GpuSceneDesc desc;
        desc.tracer = m_tracer;
        return makeTracer(m_context, m_device, scene, pose, desc);
    }
    Result<std::unique_ptr<MovableTracer>> openMovableScene(const Scene& scene, const ScenePose& pose,
                                                            const MovableDesc& movable) const override {
        return makeMovableTracer(m_context, m_device, scene, pose, movable, m_tracer);
    }
    Result<std::unique_ptr<MovableTracer>> openSdf(const SdfScene& sdf, const Scene& scene,
                                                   const ScenePose& pose) const override {
        return makeSdfTracer(m_context, m_device, sdf, scene, pose);
    }
    Result<Field> makeField(const FieldDesc& desc, const FieldSettings& settings) const override {
        return vulkan::makeField(m_context, m_device, desc, settings);
    }
    Result<std::unique_ptr<PictureRenderer>> makeRenderer() const override {
        return std::make_unique<VulkanRenderer>(m_context, m_device);
    }

private:
    Context m_context;
    Device m_device;
    TracerKind m_tracer;
};

}  // namespace

Result<std::unique_ptr<Backend>> makeBackend(const Context& context, const Device& device, TracerKind tracer) {
    if (tracer == TracerKind::rayQuery && !device.rayQuery())
        return fail(ErrorCode::unsupported, sentence("the Vulkan device '", device.info().name,
                                                     "' has no ray query; use TracerKind::bvh, or another device"));
    return std::make_unique<VulkanBackend>(context, device, tracer);
}

}  // namespace probegi::vulkan
