#include "backend/open_backend.h"

namespace probegi {

namespace {

class CpuRenderer final : public PictureRenderer {
public:
    explicit CpuRenderer(const Context& context) : m_context(context) {}

    Result<RenderedPicture> render(const Tracer& tracer, const Lighting& lighting, const Field* field,
                                   const PictureDesc& desc) override {
        return renderPicture(m_context, tracer, lighting, field, desc);
    }

private:
    Context m_context;
};

class CpuBackend final : public Backend {
public:
    explicit CpuBackend(const Context& context) : m_context(context) {}

    BackendKind kind() const noexcept override { return BackendKind::cpu; }
    Result<std::unique_ptr<Tracer>> openScene(const Scene& scene, const ScenePose& pose) const override {
        return makeEmbreeTracer(m_context, scene, pose);
    }
    Result<std::unique_ptr<MovableTracer>> openMovableScene(const Scene& scene, const ScenePose& pose,
                                                            const MovableDesc& movable) const override {
        return makeMovableEmbreeTracer(m_context, scene, pose, movable);
    }
    Result<std::unique_ptr<MovableTracer>> openSdf(const SdfScene& sdf, const Scene& scene,
                                                   const ScenePose& pose) const override {
        return makeSdfTracer(m_context, sdf, scene, pose);
    }
    Result<Field> makeField(const FieldDesc& desc, const FieldSettings& settings) const override {
        return Field::create(m_context, desc, settings);
    }
    Result<std::unique_ptr<PictureRenderer>> makeRenderer() const override {
        return std::make_unique<CpuRenderer>(m_context);
    }

private:
    Context m_context;
};

}  // namespace

std::unique_ptr<Backend> makeCpuBackend(const Context& context) {
    return std::make_unique<CpuBackend>(context);
}

}  // namespace probegi
