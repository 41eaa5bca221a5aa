#include "cpu/embree_scene.h"

#include <new>

#include "core/parallel.h"
#include "core/sentence.h"
#include "cpu/embree_filter.h"

namespace probegi {

namespace {

bool countBytes(void* sum, ssize_t bytes, bool /*afterwards*/) {
    if (bytes > 0) *static_cast<std::atomic<std::int64_t>*>(sum) += bytes;
    return true;
}

ErrorCode errorCode(RTCError error) {
    return error == RTC_ERROR_OUT_OF_MEMORY ? ErrorCode::outOfMemory : ErrorCode::invalidArgument;
}

}  // namespace

void EmbreeScene::attachMesh(RTCScene scene, const SurfaceMesh& mesh, int geometry) {
    if (mesh.empty()) return;
    const EmbreeGeometry handle(rtcNewGeometry(m_device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetSharedGeometryBuffer(handle.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(), 0,
                               sizeof(SurfaceVertex), mesh.vertices.size());
    rtcSetSharedGeometryBuffer(handle.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(SurfaceTriangle), mesh.triangles.size());
    if (geometry == SurfaceGroup::kMasked) {
        m_filters.push_back(std::make_unique<EmbreeFilterData>(EmbreeFilterData{&mesh, m_geometry.materials.data()}));
        rtcSetGeometryUserData(handle.get(), m_filters.back().get());
        rtcSetGeometryIntersectFilterFunction(handle.get(), rejectTransparent);
        rtcSetGeometryOccludedFilterFunction(handle.get(), rejectTransparent);
    }
    rtcCommitGeometry(handle.get());
    rtcAttachGeometryByID(scene, handle.get(), unsigned(geometry));
}

EmbreeSceneHandle EmbreeScene::makeScene(const SurfaceGroup& group, bool moves) {
    EmbreeSceneHandle scene(rtcNewScene(m_device.get()));
    // ROBUST: rays never pass between two triangles that share an edge. Without it 1.8 % of the rays aimed at edges of
    // a closed box were lost, and 16 % of those aimed at vertices (0.14 % with it). It costs a third of the speed,
    // mostly because Embree has no spatial splits in this mode, so a higher build quality would change nothing.
    // A movable scene is dynamic and of low quality: Embree then keeps a tree per geometry, each built once at medium
    // quality, and only rebuilds the root when something moves. Moving a door in Sponza takes 0.2 ms; without both
    // flags, Embree rebuilds the whole world, 120 ms. Rays are as fast (188 ms, 190).
    rtcSetSceneFlags(scene.get(), moves ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene.get(), moves ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
    attachMesh(scene.get(), group.opaque, SurfaceGroup::kOpaque);
    attachMesh(scene.get(), group.masked, SurfaceGroup::kMasked);
    return scene;
}

void EmbreeScene::build(bool topMoves) {
    for (const SurfaceGroup& group : m_geometry.groups) {
        m_groupScenes.push_back(makeScene(group, false));
        rtcCommitScene(m_groupScenes.back().get());
    }
    m_top = makeScene(m_geometry.world, topMoves);
    for (std::size_t i = 0; i < m_geometry.placements.size(); ++i) {
        const Placement& placement = m_geometry.placements[i];
        const EmbreeGeometry instance(rtcNewGeometry(m_device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        rtcSetGeometryInstancedScene(instance.get(), m_groupScenes[std::size_t(placement.group)].get());
        rtcSetGeometryTransform(instance.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &placement.toWorld[0][0]);
        rtcCommitGeometry(instance.get());
        rtcAttachGeometryByID(m_top.get(), instance.get(), kFirstInstance + unsigned(i));
    }
    commitTop();
}

void EmbreeScene::commitTop() {
    rtcCommitScene(m_top.get());
    RTCBounds bounds;
    rtcGetSceneBounds(m_top.get(), &bounds);
    if (bounds.lower_x <= bounds.upper_x)
        m_bounds = {{bounds.lower_x, bounds.lower_y, bounds.lower_z}, {bounds.upper_x, bounds.upper_y, bounds.upper_z}};
}

Result<std::unique_ptr<EmbreeScene>> EmbreeScene::create(const Context& context, const Scene& scene,
                                                         const ScenePose& pose, const InstancePredicate& movable) try {
    std::unique_ptr<EmbreeScene> result(new EmbreeScene(context));
    result->m_geometry = SceneGeometry::gather(scene, pose, movable);
    result->m_device.reset(rtcNewDevice(nullptr));
    if (!result->m_device)
        return fail(errorCode(rtcGetDeviceError(nullptr)),
                    "Embree could not make a device; is this processor supported?");
    rtcSetDeviceMemoryMonitorFunction(result->m_device.get(), countBytes, &result->m_allocated);
    // Within the arena Embree's tasks use the context's threads; its own "threads" option would cap all of TBB.
    runInside(context, [&] { result->build(bool(movable)); });
    if (auto checked = result->check(); !checked) return checked.error();
    return result;
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "not enough memory for the scene's triangles; use fewer triangles");
}

Result<void> EmbreeScene::check() {
    const RTCError error = rtcGetDeviceError(m_device.get());
    if (error == RTC_ERROR_NONE) return {};
    return fail(errorCode(error), sentence("Embree could not build the scene (its error code ", int(error),
                                           "); use fewer triangles or free memory"));
}

Result<void> EmbreeScene::place(const ScenePose& pose) {
    auto placements = movedPlacements(m_geometry.placements, pose);
    if (!placements) return placements.error();
    m_geometry.placements = std::move(*placements);
    for (std::size_t i = 0; i < m_geometry.placements.size(); ++i) {
        const RTCGeometry instance = rtcGetGeometry(m_top.get(), kFirstInstance + unsigned(i));
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &m_geometry.placements[i].toWorld[0][0]);
        rtcCommitGeometry(instance);
    }
    runInside(m_context, [&] { commitTop(); });
    return check();
}

}  // namespace probegi
