#include "cpu/embree_packets.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "cpu/embree_float_mode.h"

namespace probegi {

namespace {

constexpr std::size_t kWidth = 16;
/// Least cosine between the first direction of a packet and the others of a coherent one: 8 degrees.
constexpr float kCoherentCosine = 0.99f;

RTCRay single(const Ray& ray) {
    return {ray.origin.x,    ray.origin.y,    ray.origin.z, ray.near, ray.direction.x, ray.direction.y,
            ray.direction.z, 0.0f /* time */, ray.far,      ~0u,      0 /* id */,      0 /* flags */};
}

Hit miss() {
    return {};
}

/// The valid mask of the first `count` lanes.
void enable(int (&valid)[kWidth], std::size_t count) {
    for (std::size_t k = 0; k < kWidth; ++k) valid[k] = k < count ? -1 : 0;
}

/// Lanes beyond the rays repeat the first ray; they are disabled, but must hold numbers.
void load(RTCRay16& packet, std::span<const Ray> rays) {
    for (std::size_t k = 0; k < kWidth; ++k) {
        const Ray& ray = rays[k < rays.size() ? k : 0];
        packet.org_x[k] = ray.origin.x;
        packet.org_y[k] = ray.origin.y;
        packet.org_z[k] = ray.origin.z;
        packet.tnear[k] = ray.near;
        packet.dir_x[k] = ray.direction.x;
        packet.dir_y[k] = ray.direction.y;
        packet.dir_z[k] = ray.direction.z;
        packet.time[k] = 0.0f;
        packet.tfar[k] = ray.far;
        packet.mask[k] = ~0u;
        packet.id[k] = 0;
        packet.flags[k] = 0;
    }
}

void store(const RTCRayHit16& packet, std::span<Hit> hits) {
    for (std::size_t k = 0; k < hits.size(); ++k) {
        const bool missed = packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID;
        hits[k] = missed ? miss()
                         : Hit{packet.ray.tfar[k],
                               std::int32_t(packet.hit.primID[k]),
                               std::int32_t(packet.hit.geomID[k]),
                               std::int32_t(packet.hit.instID[0][k]),
                               {packet.hit.u[k], packet.hit.v[k]}};
    }
}

Hit closestHit(RTCScene scene, RTCIntersectContext* context, const Ray& ray) {
    RTCRayHit query;
    query.ray = single(ray);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return miss();
    return {query.ray.tfar,
            std::int32_t(query.hit.primID),
            std::int32_t(query.hit.geomID),
            std::int32_t(query.hit.instID[0]),
            {query.hit.u, query.hit.v}};
}

}  // namespace

EmbreePackets::EmbreePackets(RTCScene scene, float originSpread) : m_scene(scene), m_originSpread(originSpread) {
    rtcInitIntersectContext(&m_incoherent);
    rtcInitIntersectContext(&m_coherent);
    m_coherent.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
}

RTCIntersectContext* EmbreePackets::contextFor(std::span<const Ray> rays) {
    const Ray& first = rays.front();
    float cosine = 1.0f;
    glm::vec3 spread(0.0f);
    for (const Ray& ray : rays) {
        cosine = std::min(cosine, glm::dot(ray.direction, first.direction));
        spread = glm::max(spread, glm::abs(ray.origin - first.origin));
    }
    const bool near = std::max({spread.x, spread.y, spread.z}) <= m_originSpread;
    return near && cosine >= kCoherentCosine ? &m_coherent : &m_incoherent;
}

void EmbreePackets::closestHits(std::span<const Ray> rays, std::span<Hit> hits) {
    const EmbreeFloatMode floatMode;
    if (rays.size() == 1) {
        hits[0] = closestHit(m_scene, &m_incoherent, rays[0]);
        return;
    }
    alignas(64) RTCRayHit16 packet;
    alignas(64) int valid[kWidth];
    for (std::size_t i = 0; i < rays.size(); i += kWidth) {
        const std::size_t count = std::min(kWidth, rays.size() - i);
        const std::span<const Ray> batch = rays.subspan(i, count);
        enable(valid, count);
        load(packet.ray, batch);
        std::fill_n(packet.hit.geomID, kWidth, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(packet.hit.instID[0], kWidth, RTC_INVALID_GEOMETRY_ID);
        rtcIntersect16(valid, m_scene, contextFor(batch), &packet);
        store(packet, hits.subspan(i, count));
    }
}

void EmbreePackets::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    const EmbreeFloatMode floatMode;
    if (rays.size() == 1) {
        RTCRay ray = single(rays[0]);
        rtcOccluded1(m_scene, &m_incoherent, &ray);
        blocked[0] = ray.tfar < 0.0f ? 1 : 0;
        return;
    }
    alignas(64) RTCRay16 packet;
    alignas(64) int valid[kWidth];
    for (std::size_t i = 0; i < rays.size(); i += kWidth) {
        const std::size_t count = std::min(kWidth, rays.size() - i);
        const std::span<const Ray> batch = rays.subspan(i, count);
        enable(valid, count);
        load(packet, batch);
        rtcOccluded16(valid, m_scene, contextFor(batch), &packet);
        // Embree marks a blocked ray by a far end of minus infinity.
        for (std::size_t k = 0; k < count; ++k) blocked[i + k] = packet.tfar[k] < 0.0f ? 1 : 0;
    }
}

}  // namespace probegi
