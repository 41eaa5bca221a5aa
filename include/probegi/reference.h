#pragma once

#include <memory>

#include "probegi/export.h"
#include "probegi/render.h"
#include "probegi/scene.h"

namespace probegi {

/// When the reference stops: at the first limit that is reached; at least one must be set.
struct ReferenceDesc {
    PictureDesc picture;       ///< camera, size, diffuseOnly (samplesPerAxis is ignored: pixels are sampled uniformly)
    int samplesPerPixel = 64;  ///< 0: no limit
    double seconds = 0;        ///< 0: no limit
    double relativeError = 0;  ///< stop when the mean standard error over the mean luminance is below; 0: no limit
    int maxBounces = 0;        ///< 0: unlimited (Russian roulette only)
    std::uint64_t seed = 1;
    /// A converged field whose light guides the paths. It shapes the density of the samples only, so the expectation is
    /// the same whatever the field holds; how much noise it takes away depends on the scene (docs/accuracy.md), and
    /// learning takes a second or two of one processor. Null: unguided. It must outlive the call.
    const Field* guide = nullptr;
};

/// A progressive estimate: the mean, and how sure it is.
struct ReferencePicture {
    Picture picture;          ///< layers as in Picture: `direct` and `indirect` split as the field splits them
    HdrImage standardError;   ///< of color, same units
    int samplesPerPixel = 0;  ///< done
    double seconds = 0;       ///< in all
    double guideSeconds = 0;  ///< of these, to learn the guide; 0 without one
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

    /// E at each query point (toViewer is ignored), with `samples` paths a point. diffuseOnly as in PictureDesc.
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
