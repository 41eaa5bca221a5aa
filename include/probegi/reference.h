#pragma once

#include <memory>

#include "probegi/export.h"
#include "probegi/render.h"
#include "probegi/scene.h"

namespace probegi {

/// What the reference renders and when it stops: at the first limit reached. At least one limit must be set.
struct ReferenceDesc {
    PictureDesc picture;       ///< camera, size, diffuseOnly (samplesPerAxis is ignored: pixels are sampled uniformly)
    int samplesPerPixel = 64;  ///< 0: no limit
    double seconds = 0;        ///< 0: no limit
    double relativeError = 0;  ///< stop when mean standard error / mean luminance is below this; 0: no limit
    int maxBounces = 0;        ///< 0: unlimited (Russian roulette only)
    std::uint64_t seed = 1;
    /// A converged field that guides the paths. It affects the sampling density only, so the result is unbiased
    /// whatever the field holds. How much noise it removes depends on the scene (docs/accuracy.md); learning takes a
    /// second or two of processor time. Null: unguided. Must outlive the call.
    const Field* guide = nullptr;
};

/// A progressive estimate with its standard error.
struct ReferencePicture {
    Picture picture;         ///< layers as in Picture; `direct` and `indirect` split as in the field
    HdrImage standardError;  ///< of `color`, in the same units
    int samplesPerPixel = 0;
    double seconds = 0;       ///< total
    double guideSeconds = 0;  ///< of which learning the guide; 0 without one
};

/// Mean and standard error of the irradiance at a point.
struct ReferenceIrradiance {
    glm::vec3 mean{0.0f};           ///< W m^-2, from surfaces and sky: what a Field stores, punctual lights excluded
    glm::vec3 standardError{0.0f};  ///< W m^-2
};

/// The ground truth: an unbiased path tracer with next-event estimation and multiple importance sampling
/// (Veach 1997, chapter 9), materials as in appendix B of the glTF 2.0 specification.
class PROBEGI_API PathTracer {
public:
    /// The scene must be valid; it and the tracer must outlive the path tracer. Errors: outOfMemory.
    static Result<PathTracer> create(const Context& context, const Scene& scene, const ScenePose& pose,
                                     const Tracer& tracer, const Lighting& lighting);
    PathTracer(PathTracer&&) noexcept;
    PathTracer& operator=(PathTracer&&) noexcept;
    ~PathTracer();

    /// Errors: invalidArgument (no stopping rule, size), cancelled, and those of the tracer.
    Result<ReferencePicture> render(const ReferenceDesc& desc) const;

    /// E at each query point (toViewer is ignored), with `samples` paths per point. diffuseOnly as in PictureDesc.
    /// `guide` as in ReferenceDesc. Errors: invalidArgument, cancelled, and those of the tracer.
    Result<std::vector<ReferenceIrradiance>> irradiance(std::span<const FieldQuery> points, int samples,
                                                        std::uint64_t seed = 1, bool diffuseOnly = true,
                                                        const Field* guide = nullptr) const;

    struct Impl;

private:
    explicit PathTracer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

}  // namespace probegi
