#pragma once

#include <mutex>

#include "probegi/vulkan.h"
#include "vulkan/device/exchange.h"

namespace probegi::vulkan {

/// A scene in GPU memory as a Tracer; GpuSceneDesc says what can move. Batches are split, to bound the memory for them.
class GpuTracer final : public MovableTracer {
public:
    /// Uploads the scene and waits. Throws.
    GpuTracer(const Device& device, GpuScene scene);

    Result<void> closestHits(std::span<const Ray> rays, std::span<Hit> hits) const override;
    Result<void> occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override;
    Result<void> surfaces(std::span<const Ray> rays, std::span<const Hit> hits, std::span<Surface> out) const override;
    Result<void> filteredSurfaces(std::span<const Ray> rays, std::span<const Hit> hits, float spread,
                                  std::span<Surface> out) const override;
    Result<void> setPose(const ScenePose& pose) override;
    Bounds bounds() const override { return m_scene.bounds(); }
    const EmitterSet* emitters() const override;

    const Device& device() const noexcept { return m_device; }
    const GpuScene& scene() const noexcept { return m_scene; }

private:
    /// Runs a shader over the rays, and over their hits unless it finds those; take(first, answers) is told what it
    /// wrote of the rays from number `first` on, piece by piece.
    template <class Answer, class Take>
    Result<void> ask(const char* shader, std::span<const Ray> rays, std::span<const Hit> hits, float spread,
                     const Take& take) const;

    Device m_device;
    GpuScene m_scene;
    mutable std::mutex m_mutex;
    mutable Exchange m_exchange;
};

}  // namespace probegi::vulkan
