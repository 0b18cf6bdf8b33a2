// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/corridor_graph.hpp"

#include <algorithm>
#include <utility>

#include "procs/exploration/map/corridor_width.hpp"
#include "procs/exploration/map/skeleton_graph.hpp"

namespace adit {
namespace {

// Tolerance of the simplified line of a corridor.
constexpr double kStraightM = 0.3;
// A node within this distance of a frontier is its open end [m].
constexpr double kOpenEndRadiusM = 2.0;
// In a corner of a corridor the skeleton extends by up to √2 times the clearance.
constexpr double kCorner = 1.5;

/// Simplifies a skeleton graph until nothing changes: prunes spurs, dissolves nodes of degree two,
/// and contracts short lines between junctions.
class Simplifier {
 public:
  Simplifier(LineGraph graph, const DrivableSpace& space,
             const std::vector<DetectedFrontier>& frontiers, const CorridorGraphParams& params)
      : graph_(std::move(graph)), space_(space), detected_frontiers_(frontiers), params_(params) {
    lines_of_.resize(graph_.nodes.size());
    for (std::size_t i = 0; i < graph_.lines.size(); ++i) attach(static_cast<int>(i));
    for (const LineNode& node : graph_.nodes) at_frontier_.push_back(is_at_frontier(node));
  }

  CorridorGraph run() {
    bool changed = true;
    while (changed) {
      changed = false;
      changed |= prune();
      changed |= dissolve();
      changed |= contract();
    }
    return result();
  }

 private:
  [[nodiscard]] Line& line(int i) { return graph_.lines[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const LineNode& node(int i) const {
    return graph_.nodes[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] std::vector<int>& lines_of(int node) {
    return lines_of_[static_cast<std::size_t>(node)];
  }

  [[nodiscard]] bool is_at_frontier(const LineNode& node) const {
    return std::any_of(detected_frontiers_.begin(), detected_frontiers_.end(),
                       [&](const DetectedFrontier& frontier) {
                         return frontier.access == Access::kReachable &&
                                (frontier.p_map - node.p_map).norm() < kOpenEndRadiusM;
                       });
  }

  void attach(int i) {
    lines_of(line(i).from).push_back(i);
    lines_of(line(i).to).push_back(i);
  }
  void detach(int i) {
    for (const int end : {line(i).from, line(i).to}) std::erase(lines_of(end), i);
  }
  void drop(int i) {
    detach(i);
    line(i).removed = true;
  }

  /// Removes branches that end within a niche.
  bool prune() {
    bool changed = false;
    for (int i = 0; i < static_cast<int>(graph_.lines.size()); ++i) {
      if (line(i).removed) continue;
      for (const auto& [tip, root] :
           {std::pair(line(i).from, line(i).to), std::pair(line(i).to, line(i).from)}) {
        if (lines_of(tip).size() != 1 || lines_of(root).size() < 2) continue;
        if (at_frontier_[static_cast<std::size_t>(tip)]) continue;
        const double inside = kCorner * (node(root).clearance_m - space_.radius_m);
        if (length_of(line(i).points) > inside + params_.dead_end_min_m) continue;
        drop(i);
        changed = true;
        break;
      }
    }
    return changed;
  }

  /// Removes nodes of degree two and joins their lines.
  bool dissolve() {
    bool changed = false;
    for (int n = 0; n < static_cast<int>(graph_.nodes.size()); ++n) {
      const std::vector<int> both = lines_of(n);
      if (both.size() != 2 || both[0] == both[1]) continue;
      join(both[0], both[1], n);
      changed = true;
    }
    return changed;
  }

  void join(int a, int b, int through) {
    detach(a);
    detach(b);
    Line& first = line(a);
    Line& second = line(b);
    if (first.from == through) reverse(first);
    if (second.to == through) reverse(second);
    first.points.insert(first.points.end(), second.points.begin() + 1, second.points.end());
    first.to = second.to;
    first.clearance_m = std::min(first.clearance_m, second.clearance_m);
    second.removed = true;
    attach(a);
  }

  static void reverse(Line& line) {
    std::swap(line.from, line.to);
    std::reverse(line.points.begin(), line.points.end());
  }

  /// Merges junctions within the width of a corridor.
  bool contract() {
    bool changed = false;
    for (int i = 0; i < static_cast<int>(graph_.lines.size()); ++i) {
      const int from = line(i).from;
      const int to = line(i).to;
      if (line(i).removed || from == to) continue;
      if (lines_of(from).size() < 3 || lines_of(to).size() < 3) continue;
      const double width = std::max(node(from).clearance_m, node(to).clearance_m);
      if (length_of(line(i).points) > width) continue;
      drop(i);
      merge(to, from);
      changed = true;
    }
    return changed;
  }

  void merge(int merged_node, int remaining_node) {
    const Eigen::Vector2d middle = (node(merged_node).p_map + node(remaining_node).p_map) / 2.0;
    const std::vector<int> moved = lines_of(merged_node);
    for (const int i : moved) {
      if (line(i).removed) continue;
      detach(i);
      if (line(i).from == merged_node) line(i).from = remaining_node;
      if (line(i).to == merged_node) line(i).to = remaining_node;
      attach(i);
    }
    graph_.nodes[static_cast<std::size_t>(remaining_node)].p_map = middle;
    for (const int i : lines_of(remaining_node)) {
      if (line(i).from == remaining_node) line(i).points.front() = middle;
      if (line(i).to == remaining_node) line(i).points.back() = middle;
    }
    at_frontier_[static_cast<std::size_t>(remaining_node)] =
        at_frontier_[static_cast<std::size_t>(remaining_node)] ||
        at_frontier_[static_cast<std::size_t>(merged_node)];
  }

  CorridorGraph result() {
    CorridorGraph result;
    const CorridorWidth width(space_);
    std::vector<int> number(graph_.nodes.size(), -1);
    const auto number_of = [&](int n) {
      int& assigned = number[static_cast<std::size_t>(n)];
      if (assigned < 0) {
        assigned = static_cast<int>(result.nodes.size());
        result.nodes.push_back({node(n).p_map, kind_of(n)});
      }
      return assigned;
    };
    for (const Line& line : graph_.lines) {
      if (line.removed) continue;
      const int from = number_of(line.from);
      const int to = number_of(line.to);
      const double width_m = width.of(line.points).value_or(2.0 * line.clearance_m);
      result.corridors.push_back(
          {from, to, length_of(line.points), width_m, simplified(line.points, kStraightM)});
    }
    return result;
  }

  [[nodiscard]] CorridorNode::Kind kind_of(int n) {
    if (lines_of(n).size() > 1) return CorridorNode::Kind::kJunction;
    return at_frontier_[static_cast<std::size_t>(n)] ? CorridorNode::Kind::kOpenEnd
                                                     : CorridorNode::Kind::kDeadEnd;
  }

  LineGraph graph_;
  const DrivableSpace& space_;
  const std::vector<DetectedFrontier>& detected_frontiers_;
  CorridorGraphParams params_;
  std::vector<std::vector<int>> lines_of_;  ///< by node; contains a loop at a node twice
  std::vector<bool> at_frontier_;           ///< by node
};

}  // namespace

CorridorGraph corridor_graph(const DrivableSpace& space, const Grid2<std::uint8_t>& skeleton,
                             const std::vector<DetectedFrontier>& frontiers,
                             const CorridorGraphParams& params) {
  return Simplifier(line_graph(space, skeleton), space, frontiers, params).run();
}

}  // namespace adit
