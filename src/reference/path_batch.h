#pragma once

#include <span>
#include <vector>

#include "kernels/light/punctual_light.h"
#include "kernels/shade/bsdf.h"
#include "probegi/field.h"
#include "reference/transport.h"

namespace probegi {

/// Traces many independent paths in lockstep, one bounce at a time, so that the tracer's virtual calls get long
/// batches. Single-threaded; results depend only on the paths' random streams.
///
/// Unbiased with Russian roulette: after the first three reflections (with a guide, from the first) survival is at most
/// kMaxSurvival, so that paths in closed rooms of albedo 1 end as well. The cut-off at kMaxReflections is reached with
/// a probability below 0.99^4093 = 1e-17: never in practice.
class PathBatch {
public:
    static constexpr int kRouletteStart = 3;
    static constexpr float kMaxSurvival = 0.99f;
    static constexpr int kMaxReflections = 4096;
    /// Up to this many punctual lights get a shadow ray each; of more, one is chosen by its unshadowed contribution.
    static constexpr std::size_t kFewLights = 8;

    PathBatch(const Transport& transport, const PathSettings& settings);

    /// One path along each camera ray; its stream of random numbers has the ray's index. The spans are equally long.
    /// Errors: those of the tracer.
    Result<void> fromCamera(std::span<const Ray> cameraRays, std::span<const Random> random,
                            std::span<PathResult> results);
    /// One path from each point, into PathResult::irradiance: light of surfaces and sky, without punctual lights on the
    /// point itself. Errors: those of the tracer.
    Result<void> fromPoints(std::span<const FieldQuery> points, std::span<const Random> random,
                            std::span<PathResult> results);

private:
    struct Path {
        Random random;
        glm::vec3 throughput{1.0f};    ///< since the first vertex
        glm::vec3 firstColor{0.0f};    ///< BSDF x cosine / density at the first vertex
        float firstIrradiance = 0.0f;  ///< cosine / density at the first vertex
        float pdf = 0.0f;              ///< density with which the current ray's direction was sampled
        float pdfSky = 0.0f;           ///< density of light sampling for it, if it sees the sky
        float levelColor = 0.0f;       ///< expected radiance of the first vertex from the path ahead
        float levelIrradiance = 0.0f;  ///< the corresponding irradiance
        bool judged = false;           ///< whether survivalOf() uses these levels
        std::uint32_t result = 0;
        int reflections = 0;
    };

    /// A path's hit on a surface.
    struct Vertex {
        glm::vec3 position;
        glm::vec3 geometricNormal;
        glm::mat3 frame;       ///< of the shading normal
        glm::vec3 toPrevious;  ///< in the frame
        kernels::Bsdf bsdf;
        const PathGuide::Region* region = nullptr;
        float guideShare = 0.0f;  ///< of the directions that follow `mixture`
        PathGuide::Mixture mixture;
    };

    enum class Layer : std::uint8_t { direct, indirect };

    /// Light that arrives if its ray is unoccluded.
    struct Pending {
        std::uint32_t result = 0;
        Layer layer = Layer::indirect;
        int material = -1;  ///< of the emitter that must be hit at `distance` (looked-up emitters only)
        float distance = 0.0f;
        glm::vec3 color{0.0f};  ///< radiance towards the camera; per unit emission for looked-up emitters
        glm::vec3 irradiance{0.0f};
    };

    /// Contribution of unit radiance from a direction to a path's layers.
    struct Response {
        glm::vec3 color{0.0f};
        glm::vec3 irradiance{0.0f};
    };

    void begin(std::size_t count);
    Result<void> run();
    Result<void> advance();
    void shadeHit(std::size_t i);
    void addSky(const Path& path, const Ray& ray);
    void addEmission(const Path& path, const Ray& ray, const Hit& hit, const Surface& surface);
    void addTo(std::uint32_t result, Layer layer, const glm::vec3& color, const glm::vec3& irradiance);
    void recordFirstSurface(const Path& path, const Hit& hit, const Surface& surface);
    Vertex makeVertex(const Ray& ray, const Surface& surface, bool first) const;
    Response response(const Path& path, const Vertex& vertex, glm::vec3 direction) const;
    void sampleLights(Path& path, const Vertex& vertex);
    void samplePunctualLights(Path& path, const Vertex& vertex);
    void queuePunctual(const Path& path, const Vertex& vertex, const kernels::LightSample& light, float weight);
    void sampleEmitters(Path& path, const Vertex& vertex);
    void sampleSky(Path& path, const Vertex& vertex);
    bool samplesSky(const Path& path) const { return path.reflections < m_skySamples; }
    void turn(Path& path, Vertex& vertex);
    void scatter(Path& path, const Vertex& vertex);
    void expect(Path& path, const Vertex& vertex) const;
    float survivalOf(const Path& path, const Vertex& vertex) const;
    static float reflectance(const Vertex& vertex);
    void follow(const PathGuide& guide, Vertex& vertex) const;
    float pdfScatter(const Vertex& vertex, glm::vec3 local, glm::vec3 direction) const;
    Result<void> resolveShadows();
    Result<void> resolveLookUps();
    float lightSampleWeight(float pdfLight, float pdfBsdf) const;
    float bsdfSampleWeight(float pdfBsdf, float pdfLight) const;

    const Transport& m_transport;
    PathSettings m_settings;
    std::span<PathResult> m_results;
    bool m_fromPoints = false;
    int m_skySamples = 0;  ///< number of vertices of a path, from the first, that sample the sky

    std::vector<Path> m_paths;  ///< alive; parallel with the next three
    std::vector<Ray> m_rays;
    std::vector<Hit> m_hits;
    std::vector<Surface> m_surfaces;
    std::vector<Path> m_nextPaths;  ///< continuing from the vertices
    std::vector<Ray> m_nextRays;
    std::vector<Pending> m_shadows;
    std::vector<Ray> m_shadowRays;
    std::vector<std::uint8_t> m_blocked;
    std::vector<Pending> m_lookUps;
    std::vector<Ray> m_lookUpRays;
};

}  // namespace probegi
