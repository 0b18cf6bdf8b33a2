// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/plan/tunnel_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "sim/world/plan/level_plan.hpp"
#include "sim/world/plan/plan_geometry.hpp"

namespace adit {
namespace {

constexpr double kMergeDistance = 1.0;

/// One segment of a line.
struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double s_m = 0.0;  ///< at `from`

  [[nodiscard]] double length_m() const { return (to - from).norm(); }
};

std::vector<Segment> segments_of(const TunnelLine& line) {
  std::vector<Segment> segments;
  double s = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    segments.push_back({line.points[i - 1], line.points[i], s});
    s += segments.back().length_m();
  }
  return segments;
}

/// Position of the crossing on both segments, 0 to 1 within them; empty for parallel segments.
std::optional<std::pair<double, double>> crossing(const Segment& a, const Segment& b) {
  const Eigen::Vector2d u = a.to - a.from;
  const Eigen::Vector2d v = b.to - b.from;
  const double area = cross(u, v);
  if (std::abs(area) < 1e-9 * u.norm() * v.norm()) return std::nullopt;
  const double share_a = cross(b.from - a.from, v) / area;
  const double share_b = cross(b.from - a.from, u) / area;
  const bool within = share_a >= 0.0 && share_a <= 1.0 && share_b >= 0.0 && share_b <= 1.0;
  if (!within) return std::nullopt;
  return std::pair(share_a, share_b);
}

/// Where a tunnel is split at a node: the distance along it, and the position of the node.
struct TunnelSplit {
  double s_m = 0.0;                  ///< along the tunnel
  Eigen::Vector2d p_node{0.0, 0.0};  ///< p_world [m]
  bool joins_levels = false;         ///< the end of a tunnel of another level
};

/// All tunnels of a plan, and where each of them is split.
class Splitter {
 public:
  explicit Splitter(const std::vector<TunnelLine>& tunnels)
      : tunnels_(tunnels), splits_(tunnels.size()) {
    for (const TunnelLine& tunnel : tunnels) segments_.push_back(segments_of(tunnel));
  }

  /// For each tunnel, unordered: where it crosses itself or another, where another ends within half
  /// of its width, and its own ends.
  std::vector<std::vector<TunnelSplit>> splits() {
    for (std::size_t a = 0; a < tunnels_.size(); ++a) {
      for (std::size_t b = a; b < tunnels_.size(); ++b) {
        if (tunnels_[a].level == tunnels_[b].level) add_crossings(a, b);
      }
    }
    for (std::size_t a = 0; a < tunnels_.size(); ++a) {
      add_end(a, 0.0, tunnels_[a].points.front());
      add_end(a, tunnels_[a].length_m(), tunnels_[a].points.back());
    }
    return splits_;
  }

 private:
  void add_crossings(std::size_t a, std::size_t b) {
    for (std::size_t i = 0; i < segments_[a].size(); ++i) {
      // Consecutive segments of a line always meet.
      for (std::size_t j = a == b ? i + 2 : 0; j < segments_[b].size(); ++j) {
        const Segment& first = segments_[a][i];
        const Segment& second = segments_[b][j];
        const auto shares = crossing(first, second);
        if (!shares) continue;
        const Eigen::Vector2d p = first.from + shares->first * (first.to - first.from);
        splits_[a].push_back({first.s_m + shares->first * first.length_m(), p});
        splits_[b].push_back({second.s_m + shares->second * second.length_m(), p});
      }
    }
  }

  /// An end is joined to the nearest tunnel within half of that tunnel's width, or is a node of its
  /// own.
  void add_end(std::size_t a, double s_m, const Eigen::Vector2d& end) {
    double nearest = std::numeric_limits<double>::infinity();
    std::optional<std::size_t> tunnel;
    TunnelSplit foot{s_m, end};
    for (std::size_t b = 0; b < tunnels_.size(); ++b) {
      if (b == a || tunnels_[b].level != tunnels_[a].level || !tunnels_[b].contains(end)) continue;
      const TunnelLine::Place place = tunnels_[b].place_of(end);
      if (std::abs(place.across_m) >= nearest) continue;
      nearest = std::abs(place.across_m);
      tunnel = b;
      foot = {place.s_m, tunnels_[b].at(place.s_m).p_world};
    }
    splits_[a].push_back({s_m, foot.p_node, is_level_joint(tunnels_, a, end)});
    if (tunnel) splits_[*tunnel].push_back(foot);
  }

  const std::vector<TunnelLine>& tunnels_;
  std::vector<std::vector<Segment>> segments_;
  std::vector<std::vector<TunnelSplit>> splits_;
};

/// Nodes of different levels are the same only where one continues the other.
int node_at(const TunnelSplit& split, int level, std::vector<TunnelNode>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool same = nodes[i].level == level
                          ? (nodes[i].p_world - split.p_node).norm() < kMergeDistance
                          : split.joins_levels && nodes[i].p_world == split.p_node;
    if (same) return static_cast<int>(i);
  }
  nodes.push_back({split.p_node, false, level});
  return static_cast<int>(nodes.size() - 1);
}

void append(std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& p) {
  constexpr double kSame = 1e-6;
  if (points.empty() || (points.back() - p).norm() > kSame) points.push_back(p);
}

/// Node, the tunnel from one split to the next, node. Split and node differ where nodes were merged
/// or a tunnel ends at the wall of another; the end itself is then a point of the edge.
std::vector<Eigen::Vector2d> points_between(const TunnelLine& line, const TunnelSplit& from,
                                            const TunnelSplit& to, const Eigen::Vector2d& p_from,
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

void add_edges(const TunnelLine& line, std::vector<TunnelSplit> splits, TunnelGraph& graph) {
  std::stable_sort(splits.begin(), splits.end(),
                   [](const TunnelSplit& a, const TunnelSplit& b) { return a.s_m < b.s_m; });
  for (std::size_t i = 1; i < splits.size(); ++i) {
    const int from = node_at(splits[i - 1], line.level, graph.nodes);
    const int to = node_at(splits[i], line.level, graph.nodes);
    const auto& nodes = graph.nodes;
    std::vector<Eigen::Vector2d> points = points_between(
        line, splits[i - 1], splits[i], nodes[static_cast<std::size_t>(from)].p_world,
        nodes[static_cast<std::size_t>(to)].p_world);
    const double length = length_of(points);
    // Remainders between two splits of the same node; a real loop is longer.
    if (from == to && length <= 2.0 * line.width_m) continue;
    graph.edges.push_back(
        {from, to, std::move(points), length, line.width_m, line.name, line.level});
  }
}

}  // namespace

TunnelGraph tunnel_graph(const std::vector<TunnelLine>& tunnels) {
  TunnelGraph graph;
  const std::vector<std::vector<TunnelSplit>> splits = Splitter(tunnels).splits();
  for (std::size_t i = 0; i < tunnels.size(); ++i) add_edges(tunnels[i], splits[i], graph);
  for (const TunnelLine& tunnel : tunnels) {
    if (!tunnel.entrance) continue;
    const int node = node_at({0.0, tunnel.points.front()}, tunnel.level, graph.nodes);
    graph.nodes[static_cast<std::size_t>(node)].entrance = true;
  }
  return graph;
}

}  // namespace adit
