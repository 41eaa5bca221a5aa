#include "field/hysteresis.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace probegi {

namespace {

constexpr std::uint8_t kSmallLightFrames = 4;
constexpr std::uint8_t kLargeFrames = 10;
constexpr std::uint8_t kVisibilityFrames = 7;
constexpr float kSmallLightFactor = 0.85f;
constexpr float kLargeFactor = 0.5f;
constexpr float kVisibilityFactor = 0.5f;

bool isEmpty(const Bounds& box) {
    return box.lower.x > box.upper.x || box.lower.y > box.upper.y || box.lower.z > box.upper.z;
}

Bounds joined(const Bounds& a, const Bounds& b) {
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

double volumeOf(const Bounds& box) {
    const glm::dvec3 size = glm::dvec3(box.upper) - glm::dvec3(box.lower);
    return size.x * size.y * size.z;
}

}  // namespace

bool isNumber(const Bounds& box) noexcept {
    for (int axis = 0; axis < 3; ++axis)
        if (std::isnan(box.lower[axis]) || std::isnan(box.upper[axis])) return false;
    return true;
}

void EventUpdates::add(FieldEvent event) noexcept {
    switch (event) {
        case FieldEvent::smallLightChange:
            smallLight = kSmallLightFrames;
            break;
        case FieldEvent::largeLightChange:
            large = kLargeFrames;
            break;
        case FieldEvent::largeObjectChange:
            large = kLargeFrames;
            visibility = kVisibilityFrames;
            break;
        case FieldEvent::smallObjectChange:
            smallLight = kSmallLightFrames;
            visibility = kVisibilityFrames;
            break;
    }
}

void EventUpdates::join(const EventUpdates& other) noexcept {
    smallLight = std::max(smallLight, other.smallLight);
    large = std::max(large, other.large);
    visibility = std::max(visibility, other.visibility);
}

void EventUpdates::advance() noexcept {
    for (std::uint8_t* left : {&smallLight, &large, &visibility})
        if (*left > 0) --*left;
}

float EventUpdates::irradianceFactor() const noexcept {
    return std::min(smallLight > 0 ? kSmallLightFactor : 1.0f, large > 0 ? kLargeFactor : 1.0f);
}

float EventUpdates::visibilityFactor() const noexcept {
    return visibility > 0 ? kVisibilityFactor : 1.0f;
}

kernels::EventLimit EventUpdates::limit(const FieldSettings& settings) const noexcept {
    const float light = irradianceFactor(), distances = visibilityFactor();
    kernels::EventLimit limit = kernels::noEventLimit();
    if (light < 1) limit.irradianceKept = settings.hysteresis * light;
    if (distances < 1) limit.visibilityKept = settings.visibilityHysteresis * distances;
    return limit;
}

void HysteresisSchedule::notify(FieldEvent event) noexcept {
    m_everywhere.add(event);
}

void HysteresisSchedule::notify(FieldEvent event, const Bounds& box) noexcept {
    if (!isNumber(box)) return notify(event);
    if (isEmpty(box)) return;
    Region coming{box, {}};
    coming.left.add(event);
    const auto end = m_regions.begin() + std::ptrdiff_t(m_count);
    const auto same = std::find_if(
        m_regions.begin(), end, [&](const Region& r) { return r.box.lower == box.lower && r.box.upper == box.upper; });
    if (same != end) return same->left.join(coming.left);
    if (m_count < m_regions.size()) {
        m_regions[m_count++] = coming;
        return;
    }
    const auto growth = [&](const Region& r) { return volumeOf(joined(r.box, box)) - volumeOf(r.box); };
    Region& nearest = *std::min_element(m_regions.begin(), end,
                                        [&](const Region& a, const Region& b) { return growth(a) < growth(b); });
    nearest.box = joined(nearest.box, box);
    nearest.left.join(coming.left);
}

FrameHysteresis HysteresisSchedule::current(const FieldSettings& settings, bool firstFrame) const noexcept {
    if (firstFrame) return {};
    return {settings.hysteresis * m_everywhere.irradianceFactor(),
            settings.visibilityHysteresis * m_everywhere.visibilityFactor()};
}

EventRegions HysteresisSchedule::regions(const FieldSettings& settings, bool firstFrame) const noexcept {
    EventRegions regions;
    if (firstFrame) return regions;  // keeps nothing anyway
    for (std::size_t i = 0; i < m_count; ++i) {
        const Region& r = m_regions[i];
        const kernels::EventLimit limit = r.left.limit(settings);
        regions.boxes[std::size_t(regions.count++)] = {r.box.lower, r.box.upper, limit.irradianceKept,
                                                       limit.visibilityKept};
    }
    return regions;
}

void HysteresisSchedule::advance() noexcept {
    m_everywhere.advance();
    const auto end = m_regions.begin() + std::ptrdiff_t(m_count);
    for (auto r = m_regions.begin(); r != end; ++r) r->left.advance();
    m_count = std::size_t(std::remove_if(m_regions.begin(), end, [](const Region& r) { return r.left.over(); }) -
                          m_regions.begin());
}

}  // namespace probegi
