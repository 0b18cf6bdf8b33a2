// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/graph_structure.hpp"

#include <numeric>

namespace adit {
namespace {

/// Sets of nodes that are linked, each known by its smallest member.
class LinkedSets {
 public:
  explicit LinkedSets(std::size_t nodes) : parent_(nodes) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::size_t smallest(std::size_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  void link(std::size_t a, std::size_t b) {
    a = smallest(a);
    b = smallest(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

GraphStructure analyse(const PoseGraph& graph) {
  GraphStructure structure;
  structure.pattern.blocks = static_cast<int>(graph.poses.size()) - 1;
  for (const PoseConstraint& c : graph.constraints) {
    const bool with_fixed = c.from == 0 || c.to == 0;
    structure.pair_of_constraint.push_back(
        with_fixed ? -1 : static_cast<int>(structure.pattern.pairs.size()));
    if (!with_fixed) structure.pattern.pairs.push_back({c.from - 1, c.to - 1});
  }
  structure.ordering = order_blocks(structure.pattern);
  return structure;
}

std::optional<int> first_unconnected_node(const PoseGraph& graph) {
  LinkedSets sets(graph.poses.size());
  for (const PoseConstraint& c : graph.constraints) {
    sets.link(static_cast<std::size_t>(c.from), static_cast<std::size_t>(c.to));
  }
  for (std::size_t node = 0; node < graph.poses.size(); ++node) {
    if (sets.smallest(node) != 0) return static_cast<int>(node);
  }
  return std::nullopt;
}

}  // namespace adit
