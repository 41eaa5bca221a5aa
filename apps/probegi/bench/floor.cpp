#include "bench/floor.h"

#if PROBEGI_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <chrono>
#include <new>
#include <vector>

namespace probegi::tool {

namespace {

constexpr std::size_t kRaysPerTask = 1024;

struct Triangles {
    std::vector<glm::vec3> vertices;
    std::vector<std::uint32_t> indices;
};

void append(Triangles& all, const Primitive& primitive, const glm::mat4& toWorld) {
    const auto first = std::uint32_t(all.vertices.size());
    for (const glm::vec3& position : primitive.positions)
        all.vertices.push_back(glm::vec3(toWorld * glm::vec4(position, 1.0f)));
    for (const std::uint32_t index : primitive.indices) all.indices.push_back(first + index);
}

Triangles trianglesOf(const Scene& scene, const ScenePose& pose) {
    Triangles all;
    for (const Instance& instance : pose.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            append(all, primitive, instance.toWorld);
    all.vertices.emplace_back();  // padding: Embree reads 16 bytes at the last vertex
    return all;
}

// Sets denormals to zero while it lives, as Embree's manual requires.
class FlushDenormals {
public:
    FlushDenormals() : m_before(_mm_getcsr()) { _mm_setcsr(m_before | 0x8040u); }
    ~FlushDenormals() { _mm_setcsr(m_before); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    unsigned m_before;
};

void traceInOrder(RTCScene scene, std::span<const Ray> rays) {
    const FlushDenormals mode;
#if RTC_VERSION_MAJOR < 4
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
#endif
    for (const Ray& ray : rays) {
        RTCRayHit query;
        query.ray = {ray.origin.x,    ray.origin.y,    ray.origin.z, ray.near, ray.direction.x, ray.direction.y,
                     ray.direction.z, 0.0f /* time */, ray.far,      ~0u,      0 /* id */,      0 /* flags */};
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR < 4
        rtcIntersect1(scene, &context, &query);
#else
        rtcIntersect1(scene, &query);
#endif
    }
}

}  // namespace

struct RawEmbree::Impl {
    explicit Impl(int threads) : arena(threads) {}
    ~Impl() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    mutable tbb::task_arena arena;
    Triangles triangles;  // Embree reads them in place
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
};

RawEmbree::RawEmbree(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
RawEmbree::RawEmbree(RawEmbree&&) noexcept = default;
RawEmbree& RawEmbree::operator=(RawEmbree&&) noexcept = default;
RawEmbree::~RawEmbree() = default;

Result<RawEmbree> RawEmbree::create(const Scene& scene, const ScenePose& pose, int threads, bool robust) try {
    auto impl = std::make_unique<Impl>(threads);
    impl->triangles = trianglesOf(scene, pose);
    const Triangles& t = impl->triangles;
    const RTCGeometry geometry = rtcNewGeometry(impl->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, t.vertices.data(), 0,
                               sizeof(glm::vec3), t.vertices.size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, t.indices.data(), 0,
                               3 * sizeof(std::uint32_t), t.indices.size() / 3);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(impl->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    impl->arena.execute([&] { rtcCommitScene(impl->scene); });
    if (rtcGetDeviceError(impl->device) != RTC_ERROR_NONE)
        return fail(ErrorCode::outOfMemory, "Embree could not build the benchmark's scene; choose a smaller one");
    return RawEmbree(std::move(impl));
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "not enough memory for the benchmark's triangles; choose a smaller scene");
}

double RawEmbree::trace(std::span<const Ray> rays) const {
    const auto start = std::chrono::steady_clock::now();
    m_impl->arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), kRaysPerTask), [&](const auto& range) {
            traceInOrder(m_impl->scene, rays.subspan(range.begin(), range.size()));
        });
    });
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace probegi::tool
