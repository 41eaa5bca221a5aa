#pragma once

// Embree 3 or 4: the only place that handles their differences. CMake sets which one is linked (PROBEGI_EMBREE_MAJOR).
#if PROBEGI_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#if RTC_VERSION_MAJOR != PROBEGI_EMBREE_MAJOR
#error "the headers of Embree that were found are not of the version that is linked"
#endif

namespace probegi {

/// Tracing calls for coherent or incoherent rays: with an intersection context in Embree 3, with arguments in Embree 4.
/// One thread at a time.
class EmbreeCalls {
public:
#if RTC_VERSION_MAJOR >= 4
    explicit EmbreeCalls(bool coherent) {
        const RTCRayQueryFlags flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
        rtcInitIntersectArguments(&m_intersect);
        rtcInitOccludedArguments(&m_occluded);
        m_intersect.flags = m_occluded.flags = flags;
    }
    void intersect1(RTCScene scene, RTCRayHit& query) {
        rtcIntersect1(scene, &query, &m_intersect);
    }
    void intersect16(const int* valid, RTCScene scene, RTCRayHit16& packet) {
        rtcIntersect16(valid, scene, &packet, &m_intersect);
    }
    void occluded1(RTCScene scene, RTCRay& ray) {
        rtcOccluded1(scene, &ray, &m_occluded);
    }
    void occluded16(const int* valid, RTCScene scene, RTCRay16& packet) {
        rtcOccluded16(valid, scene, &packet, &m_occluded);
    }

private:
    RTCIntersectArguments m_intersect;
    RTCOccludedArguments m_occluded;
#else
    explicit EmbreeCalls(bool coherent) {
        rtcInitIntersectContext(&m_context);
        m_context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }
    void intersect1(RTCScene scene, RTCRayHit& query) {
        rtcIntersect1(scene, &m_context, &query);
    }
    void intersect16(const int* valid, RTCScene scene, RTCRayHit16& packet) {
        rtcIntersect16(valid, scene, &m_context, &packet);
    }
    void occluded1(RTCScene scene, RTCRay& ray) {
        rtcOccluded1(scene, &m_context, &ray);
    }
    void occluded16(const int* valid, RTCScene scene, RTCRay16& packet) {
        rtcOccluded16(valid, scene, &m_context, &packet);
    }

private:
    RTCIntersectContext m_context;
#endif
};

}  // namespace probegi
