#include "cpu/embree_packets.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "core/float_mode.h"

namespace probegi {

namespace {

constexpr std::size_t kWidth = 16;
/// Minimum cosine between the first direction of a coherent packet and the others: 8 degrees.
constexpr float kCoherentCosine = 0.99f;

RTCRay single(const Ray& ray) {
    return {ray.origin.x,    ray.origin.y,
            ray.origin.z,    std::max(0.0f, ray.near),
            ray.direction.x, ray.direction.y,
            ray.direction.z, 0.0f /* time */,
            ray.far,         ~0u,
            0 /* id */,      0 /* flags */};
}

Hit miss() {
    return {};
}

/// Beyond this Embree's arithmetic overflows; it asserts on such rays, and on NaN.
constexpr float kLargest = 1.8e18f;

bool usable(const Ray& ray) {
    const glm::vec3 o = glm::abs(ray.origin), d = glm::abs(ray.direction);
    return o.x <= kLargest && o.y <= kLargest && o.z <= kLargest && d.x <= kLargest && d.y <= kLargest &&
           d.z <= kLargest && std::max(0.0f, ray.near) <= ray.far;
}

/// 1 or 0, for sums without branches.
int inRange(float x) {
    return std::abs(x) <= kLargest ? 1 : 0;
}

/// Embree's mask of lanes with usable rays: -1 or 0. Where Embree has no packets of 16 (AVX2), it splits them and
/// ignores the mask, so the other lanes also get an empty interval. Branch-free, for SIMD.
void findUsable(RTCRay16& r, std::size_t count, int (&valid)[kWidth]) {
    for (std::size_t k = 0; k < kWidth; ++k) {
        const int origin = inRange(r.org_x[k]) & inRange(r.org_y[k]) & inRange(r.org_z[k]);
        const int direction = inRange(r.dir_x[k]) & inRange(r.dir_y[k]) & inRange(r.dir_z[k]);
        const int interval = r.tnear[k] <= r.tfar[k] ? 1 : 0;
        valid[k] = -(origin & direction & interval & (k < count ? 1 : 0));
        r.tfar[k] = valid[k] != 0 ? r.tfar[k] : -std::numeric_limits<float>::infinity();
    }
}

/// Whether Embree should traverse the packet coherently: nearly the same origin and direction.
bool coherent(const RTCRay16& r, float originSpread) {
    float cosine = 1.0f, spread = 0.0f;
    for (std::size_t k = 0; k < kWidth; ++k) {
        const float dot = r.dir_x[k] * r.dir_x[0] + r.dir_y[k] * r.dir_y[0] + r.dir_z[k] * r.dir_z[0];
        cosine = dot < cosine ? dot : cosine;
        const float x = std::abs(r.org_x[k] - r.org_x[0]), y = std::abs(r.org_y[k] - r.org_y[0]);
        const float z = std::abs(r.org_z[k] - r.org_z[0]);
        spread = x > spread ? x : spread;
        spread = y > spread ? y : spread;
        spread = z > spread ? z : spread;
    }
    return spread <= originSpread && cosine >= kCoherentCosine;
}

/// Excess lanes repeat the first ray: disabled, but still read by Embree and coherent().
void load(RTCRay16& packet, std::span<const Ray> rays) {
    for (std::size_t k = 0; k < kWidth; ++k) {
        const Ray& ray = rays[k < rays.size() ? k : 0];
        packet.org_x[k] = ray.origin.x;
        packet.org_y[k] = ray.origin.y;
        packet.org_z[k] = ray.origin.z;
        packet.tnear[k] = std::max(0.0f, ray.near);
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

Hit closestHit(RTCScene scene, EmbreeCalls& calls, const Ray& ray) {
    if (!usable(ray)) return miss();
    RTCRayHit query;
    query.ray = single(ray);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    calls.intersect1(scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return miss();
    return {query.ray.tfar,
            std::int32_t(query.hit.primID),
            std::int32_t(query.hit.geomID),
            std::int32_t(query.hit.instID[0]),
            {query.hit.u, query.hit.v}};
}

bool occludedOne(RTCScene scene, EmbreeCalls& calls, const Ray& ray) {
    if (!usable(ray)) return false;
    RTCRay query = single(ray);
    calls.occluded1(scene, query);
    return query.tfar < 0.0f;  // Embree marks a blocked ray with minus infinity
}

}  // namespace

EmbreePackets::EmbreePackets(RTCScene scene, float originSpread, bool instanced)
    : m_scene(scene), m_originSpread(originSpread), m_instanced(instanced) {}

void EmbreePackets::closestHits(std::span<const Ray> rays, std::span<Hit> hits) {
    const FloatMode floatMode;
    if (rays.size() == 1) {
        hits[0] = closestHit(m_scene, m_incoherent, rays[0]);
        return;
    }
    alignas(64) RTCRayHit16 packet;
    alignas(64) int valid[kWidth];
    for (std::size_t i = 0; i < rays.size(); i += kWidth) {
        const std::size_t count = std::min(kWidth, rays.size() - i);
        const std::span<const Ray> batch = rays.subspan(i, count);
        load(packet.ray, batch);
        findUsable(packet.ray, count, valid);
        std::fill_n(packet.hit.geomID, kWidth, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(packet.hit.instID[0], kWidth, RTC_INVALID_GEOMETRY_ID);
        const bool together = coherent(packet.ray, m_originSpread);
        (together ? m_coherent : m_incoherent).intersect16(valid, m_scene, packet);
        store(packet, hits.subspan(i, count));
    }
}

void EmbreePackets::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    const FloatMode floatMode;
    if (rays.size() == 1) {
        blocked[0] = occludedOne(m_scene, m_incoherent, rays[0]);
        return;
    }
    alignas(64) RTCRay16 packet;
    alignas(64) int valid[kWidth];
    for (std::size_t i = 0; i < rays.size(); i += kWidth) {
        const std::size_t count = std::min(kWidth, rays.size() - i);
        const std::span<const Ray> batch = rays.subspan(i, count);
        load(packet, batch);
        findUsable(packet, count, valid);
        const bool together = !m_instanced && coherent(packet, m_originSpread);
        (together ? m_coherent : m_incoherent).occluded16(valid, m_scene, packet);
        for (std::size_t k = 0; k < count; ++k) blocked[i + k] = valid[k] != 0 && packet.tfar[k] < 0.0f;
    }
}

}  // namespace probegi
