#include "vulkan/tracers/gpu_tracer.h"

#include <algorithm>
#include <cassert>

#include "kernels/abi/gpu_passes.h"
#include "vulkan/scene/gpu_scene_impl.h"

namespace probegi::vulkan {

namespace {

constexpr std::size_t kRaysPerPiece = std::size_t(1) << 20;

std::unique_ptr<GpuTracer> uploaded(const Context& context, const Device& device, const Scene& scene,
                                    const ScenePose& pose, const GpuSceneDesc& desc) {
    return std::make_unique<GpuTracer>(device, orThrow(GpuScene::create(context, device, scene, pose, desc)));
}

Surface surfaceOf(const kernels::GpuSurface& s) {
    Surface surface;
    surface.position = s.position;
    surface.geometricNormal = s.geometricNormal;
    surface.shadingNormal = s.shadingNormal;
    surface.albedo = s.albedo;
    surface.emission = s.emission;
    surface.metallic = s.metallic;
    surface.roughness = s.roughness;
    surface.material = s.material;
    surface.back = s.side != kernels::kSideFront;
    surface.backface = s.side == kernels::kSideBackface;
    return surface;
}

}  // namespace

GpuTracer::GpuTracer(const Device& device, GpuScene scene)
    : m_device(device), m_scene(std::move(scene)), m_exchange(device) {
    submitAndWait(device, [&](const Recorder& recorder) { orThrow(m_scene.recordUpload(recorder.commands())); });
    m_scene.releaseStaging();
}

const EmitterSet* GpuTracer::emitters() const {
    const GpuScene::Impl& scene = m_scene.impl();
    return scene.primitives && scene.emitters.empty() ? nullptr : &scene.emitters;
}

template <class Answer, class Take>
Result<void> GpuTracer::ask(const char* shader, std::span<const Ray> rays, std::span<const Hit> hits, float spread,
                            const Take& take) const {
    const std::lock_guard lock(m_mutex);
    const auto askPiece = [&](std::size_t first, std::size_t count) {
        m_exchange.begin(count * (sizeof(Ray) + (hits.empty() ? 0 : sizeof(Hit))), count * sizeof(Answer));
        kernels::RaysPush push{};
        push.rays = packAddress(m_exchange.add(rays.subspan(first, count)));
        push.results = packAddress(m_exchange.out());
        push.hits = hits.empty() ? push.results : packAddress(m_exchange.add(hits.subspan(first, count)));
        push.count = std::uint32_t(count);
        push.spread = spread;
        m_exchange.run(
            [&](const Recorder& recorder) {
                recorder.bindScene(m_scene.impl().set());
                recorder.push(push);
                recorder.dispatchOver(m_scene.impl().shader(shader), count);
            },
            count * sizeof(Answer));
        take(first, m_exchange.results<Answer>().first(count));
    };
    return guarded("tracing rays", [&] {
        for (std::size_t first = 0; first < rays.size(); first += kRaysPerPiece)
            askPiece(first, std::min(kRaysPerPiece, rays.size() - first));
    });
}

Result<void> GpuTracer::closestHits(std::span<const Ray> rays, std::span<Hit> hits) const {
    assert(rays.size() == hits.size());
    return ask<Hit>("trace_rays", rays, {}, 0.0f, [&](std::size_t first, std::span<const Hit> found) {
        std::copy(found.begin(), found.end(), hits.begin() + std::ptrdiff_t(first));
    });
}

Result<void> GpuTracer::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
    assert(rays.size() == blocked.size());
    return ask<std::uint32_t>("trace_occlusion", rays, {}, 0.0f,
                              [&](std::size_t first, std::span<const std::uint32_t> results) {
                                  for (std::size_t i = 0; i < results.size(); ++i)
                                      blocked[first + i] = std::uint8_t(results[i]);
                              });
}

Result<void> GpuTracer::surfaces(std::span<const Ray> rays, std::span<const Hit> hits, std::span<Surface> out) const {
    return filteredSurfaces(rays, hits, 0.0f, out);
}

Result<void> GpuTracer::filteredSurfaces(std::span<const Ray> rays, std::span<const Hit> hits, float spread,
                                         std::span<Surface> out) const {
    assert(rays.size() == hits.size() && rays.size() == out.size());
    return ask<kernels::GpuSurface>("surfaces", rays, hits, spread,
                                    [&](std::size_t first, std::span<const kernels::GpuSurface> results) {
                                        for (std::size_t i = 0; i < results.size(); ++i)
                                            if (hits[first + i].valid()) out[first + i] = surfaceOf(results[i]);
                                    });
}

Result<void> GpuTracer::setPose(const ScenePose& pose) {
    const std::lock_guard lock(m_mutex);
    return guarded("moving instances", [&] {
        submitAndWait(m_device,
                      [&](const Recorder& recorder) { orThrow(m_scene.recordPose(recorder.commands(), pose)); });
    });
}

Result<std::unique_ptr<Tracer>> makeTracer(const Context& context, const Device& device, const Scene& scene,
                                           const ScenePose& pose, const GpuSceneDesc& desc) {
    return guarded("uploading the scene",
                   [&] { return std::unique_ptr<Tracer>(uploaded(context, device, scene, pose, desc)); });
}

Result<std::unique_ptr<MovableTracer>> makeMovableTracer(const Context& context, const Device& device,
                                                         const Scene& scene, const ScenePose& pose,
                                                         const MovableDesc& movable, TracerKind tracer) {
    const GpuSceneDesc desc{.tracer = tracer, .movable = movable.animated, .movableNodes = movable.nodes};
    return guarded("uploading the scene",
                   [&] { return std::unique_ptr<MovableTracer>(uploaded(context, device, scene, pose, desc)); });
}

Result<std::unique_ptr<MovableTracer>> makeSdfTracer(const Context& context, const Device& device, const SdfScene& sdf,
                                                     const Scene& scene, const ScenePose& pose) {
    GpuSceneDesc desc;
    desc.tracer = TracerKind::sdf;
    desc.sdf = &sdf;
    return guarded("uploading the primitives",
                   [&] { return std::unique_ptr<MovableTracer>(uploaded(context, device, scene, pose, desc)); });
}

}  // namespace probegi::vulkan
