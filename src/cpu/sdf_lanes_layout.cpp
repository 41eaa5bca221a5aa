#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "cpu/sdf_lanes.h"
#include "sdf/placed_primitives.h"
#include "sdf/solid.h"

namespace probegi {

namespace {

using kernels::SdfSolid;

/// Lanes of the widest instruction set.
constexpr std::size_t kMostLanes = 16;

bool isSharpBox(const SdfSolid& solid) {
    return solid.shape <= kernels::kSdfRoundedBox && kernels::sdfRounding(solid) <= 0;
}

/// Where a quarter turn leads v, but for rounding: exactly there.
glm::vec3 alongAnAxis(glm::vec3 v) {
    const glm::vec3 whole = glm::round(v);
    return glm::dot(whole - v, whole - v) < 1e-12f ? whole : v;
}

SdfLanes::Box boxAround(const SdfSolid& solid, std::size_t number) {
    SdfLanes::Box box;
    box.centre = solid.centre;
    box.halfSize = halfExtents(solid);
    box.solid = std::int32_t(number);
    box.exact = isSharpBox(solid) ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 along(0.0f);
        along[axis] = 1;
        box.axes[std::size_t(axis)] = alongAnAxis(kernels::sdfToWorld(solid, along));
    }
    return box;
}

/// Whether each axis of the frame is one of the world's.
bool isAligned(const SdfLanes::Box& box) {
    return std::all_of(box.axes.begin(), box.axes.end(), [](glm::vec3 axis) { return axis == glm::round(axis); });
}

/// An aligned box without its frame.
SdfLanes::Box straightened(const SdfLanes::Box& box) {
    SdfLanes::Box straight = box;
    straight.halfSize = glm::vec3(0.0f);
    for (int axis = 0; axis < 3; ++axis)
        straight.halfSize += glm::abs(box.axes[std::size_t(axis)]) * box.halfSize[axis];
    return straight;
}

}  // namespace

SdfLanes::SdfLanes(std::span<const SdfSolid> solids) : m_solids(solids.begin(), solids.end()) {
    std::vector<Box> turned, others;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const Box box = boxAround(solids[i], i);
        if (box.exact == 0) {
            others.push_back(box);
        } else if (isAligned(box)) {
            m_boxes.push_back(straightened(box));
        } else {
            turned.push_back(box);
        }
    }
    m_aligned = m_boxes.size();
    m_boxes.insert(m_boxes.end(), turned.begin(), turned.end());
    m_boxes.insert(m_boxes.end(), others.begin(), others.end());
    for (const Box& box : m_boxes) addAround(boundsOf(m_solids[std::size_t(box.solid)]));
    pad();
}

void SdfLanes::addAround(const Bounds& bounds) {
    for (int axis = 0; axis < 3; ++axis) {
        m_around.centre[std::size_t(axis)].push_back(bounds.centre()[axis]);
        m_around.halfSize[std::size_t(axis)].push_back(0.5f * bounds.size()[axis]);
    }
}

void SdfLanes::pad() {
    const std::size_t length = (m_boxes.size() + kMostLanes - 1) / kMostLanes * kMostLanes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        m_around.centre[axis].resize(length, 0.0f);
        m_around.halfSize[axis].resize(length, -kernels::kSdfFar);
    }
}

}  // namespace probegi
