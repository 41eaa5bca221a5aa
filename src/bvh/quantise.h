#pragma once

#include <functional>
#include <vector>

#include "bvh/collapse.h"
#include "kernels/trace/bvh_scene.h"

namespace probegi {

/// Nodes without planes: what stands where.
std::vector<kernels::BvhNode> makeNodes(const WideTree& tree);

/// Sets the planes of all nodes from the boxes of the leaves' items (by their place in the leaves; kNothing for one
/// that is not to be met), and returns the box of everything.
Bounds fitNodes(std::vector<kernels::BvhNode>& nodes, const std::function<Bounds(std::uint32_t)>& itemBox);

}  // namespace probegi
