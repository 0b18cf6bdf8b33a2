// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/drift_graph.hpp"

#include <algorithm>

#include "sim/world/drift_splits.hpp"

namespace adit {
namespace {

constexpr double kMergeDistance = 1.0;

int node_at(const Eigen::Vector2d& p_world, std::vector<DriftNode>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if ((nodes[i].p_world - p_world).norm() < kMergeDistance) return static_cast<int>(i);
  }
  nodes.push_back({p_world, false});
  return static_cast<int>(nodes.size() - 1);
}

void append(std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& p) {
  constexpr double kSame = 1e-6;
  if (points.empty() || (points.back() - p).norm() > kSame) points.push_back(p);
}

/// Node, the drift from one split to the next, node. A split and its node are apart where two nodes
/// are one, or a drift ends at the wall of another: the end itself is then on the way.
std::vector<Eigen::Vector2d> points_between(const DriftLine& line, const DriftSplit& from,
                                            const DriftSplit& to, const Eigen::Vector2d& p_from,
                                            const Eigen::Vector2d& p_to) {
  std::vector<Eigen::Vector2d> points{p_from};
  const auto add_if_far = [&](double s_m, const Eigen::Vector2d& p_node) {
    const Eigen::Vector2d p = line.at(s_m).p_world;
    if ((p - p_node).norm() >= kMergeDistance) append(points, p);
  };
  add_if_far(from.s_m, p_from);
  double s_m = 0.0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if (i > 0) s_m += (line.points[i] - line.points[i - 1]).norm();
    if (s_m > from.s_m && s_m < to.s_m) append(points, line.points[i]);
  }
  add_if_far(to.s_m, p_to);
  append(points, p_to);
  return points;
}

double length_of(const std::vector<Eigen::Vector2d>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

void add_edges(const DriftLine& line, std::vector<DriftSplit> splits, DriftGraph& graph) {
  std::stable_sort(splits.begin(), splits.end(),
                   [](const DriftSplit& a, const DriftSplit& b) { return a.s_m < b.s_m; });
  for (std::size_t i = 1; i < splits.size(); ++i) {
    const int from = node_at(splits[i - 1].p_node, graph.nodes);
    const int to = node_at(splits[i].p_node, graph.nodes);
    const auto& nodes = graph.nodes;
    std::vector<Eigen::Vector2d> points = points_between(
        line, splits[i - 1], splits[i], nodes[static_cast<std::size_t>(from)].p_world,
        nodes[static_cast<std::size_t>(to)].p_world);
    const double length = length_of(points);
    // What is left between two places that are one node; a loop is longer.
    if (from == to && length <= 2.0 * line.width_m) continue;
    graph.edges.push_back({from, to, std::move(points), length, line.width_m, line.name});
  }
}

}  // namespace

DriftGraph drift_graph(const std::vector<DriftLine>& drifts) {
  DriftGraph graph;
  const std::vector<std::vector<DriftSplit>> splits = drift_splits(drifts);
  for (std::size_t i = 0; i < drifts.size(); ++i) add_edges(drifts[i], splits[i], graph);
  for (const DriftLine& drift : drifts) {
    if (!drift.entrance) continue;
    const int node = node_at(drift.points.front(), graph.nodes);
    graph.nodes[static_cast<std::size_t>(node)].entrance = true;
  }
  return graph;
}

}  // namespace adit
