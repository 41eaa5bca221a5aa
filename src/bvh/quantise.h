#pragma once

#include <functional>
#include <vector>

#include "bvh/collapse.h"
#include "kernels/trace/bvh_scene.h"

namespace probegi {

/// Nodes without planes: topology only.
std::vector<kernels::BvhNode> makeNodes(const WideTree& tree);

/// Sets the planes of all nodes from the boxes of the leaves' items (by position in the leaves; kNothing for one that
/// rays must not hit), and returns the total bounds.
Bounds fitNodes(std::vector<kernels::BvhNode>& nodes, const std::function<Bounds(std::uint32_t)>& itemBox);

}  // namespace probegi
