#pragma once

#include <memory>
#include <span>

#include "probegi/tracer.h"

namespace probegi::tool {

/// The floor that everything is measured against: Embree alone, one rtcIntersect1 per ray, in order. All triangles of
/// the pose are in world space in one geometry; there are no alpha masks or materials, and hits are not read.
class RawEmbree {
public:
    /// @param robust  RTC_SCENE_FLAG_ROBUST, which ProbeGI's own tracer sets; Embree is fastest without it
    /// Errors: outOfMemory.
    static Result<RawEmbree> create(const Scene& scene, const ScenePose& pose, int threads, bool robust);
    RawEmbree(RawEmbree&&) noexcept;
    RawEmbree& operator=(RawEmbree&&) noexcept;
    ~RawEmbree();

    /// Traces the rays on all its threads. Returns the wall-clock milliseconds.
    double trace(std::span<const Ray> rays) const;

private:
    struct Impl;
    explicit RawEmbree(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

}  // namespace probegi::tool
