// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/drift_graph.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace adit {
namespace {

constexpr double kMergeDistance = 1.0;

/// Where a drift is split: the place along it, and the place of the node.
struct Split {
  double s_m = 0.0;
  Eigen::Vector2d p_node{0.0, 0.0};
};

/// One straight piece of a line.
struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double s_m = 0.0;  ///< at `from`

  [[nodiscard]] double length_m() const { return (to - from).norm(); }
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

std::vector<Segment> segments_of(const DriftLine& line) {
  std::vector<Segment> segments;
  double s = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    segments.push_back({line.points[i - 1], line.points[i], s});
    s += segments.back().length_m();
  }
  return segments;
}

/// Shares of both segments at which they cross; nothing for parallel ones.
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

/// All drifts of a plan, and where each of them is to be split.
class Splitter {
 public:
  explicit Splitter(const std::vector<DriftLine>& drifts)
      : drifts_(drifts), splits_(drifts.size()) {
    for (const DriftLine& drift : drifts) segments_.push_back(segments_of(drift));
  }

  std::vector<std::vector<Split>> splits() {
    for (std::size_t a = 0; a < drifts_.size(); ++a) {
      for (std::size_t b = a; b < drifts_.size(); ++b) add_crossings(a, b);
    }
    for (std::size_t a = 0; a < drifts_.size(); ++a) {
      add_end(a, 0.0, drifts_[a].points.front());
      add_end(a, drifts_[a].length_m(), drifts_[a].points.back());
    }
    return splits_;
  }

 private:
  void add_crossings(std::size_t a, std::size_t b) {
    for (std::size_t i = 0; i < segments_[a].size(); ++i) {
      // Neighbours within one line always meet.
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

  /// An end belongs to the nearest drift within half its width, or is a node of its own.
  void add_end(std::size_t a, double s_m, const Eigen::Vector2d& end) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t drift = a;
    Split foot{s_m, end};
    for (std::size_t b = 0; b < drifts_.size(); ++b) {
      if (b == a || !drifts_[b].reaches(end)) continue;
      for (const Segment& segment : segments_[b]) {
        const Split here = foot_on(segment, end);
        const double distance = (here.p_node - end).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        drift = b;
        foot = here;
      }
    }
    splits_[a].push_back({s_m, foot.p_node});
    if (drift != a) splits_[drift].push_back(foot);
  }

  static Split foot_on(const Segment& segment, const Eigen::Vector2d& p) {
    const Eigen::Vector2d along = segment.to - segment.from;
    const double share = std::clamp((p - segment.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return {segment.s_m + share * segment.length_m(), segment.from + share * along};
  }

  const std::vector<DriftLine>& drifts_;
  std::vector<std::vector<Segment>> segments_;
  std::vector<std::vector<Split>> splits_;
};

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
std::vector<Eigen::Vector2d> points_between(const DriftLine& line, const Split& from,
                                            const Split& to, const Eigen::Vector2d& p_from,
                                            const Eigen::Vector2d& p_to) {
  std::vector<Eigen::Vector2d> points{p_from};
  const auto add_if_far = [&](double s_m, const Eigen::Vector2d& p_node) {
    const Eigen::Vector2d p = line.at(s_m).p_world;
    if ((p - p_node).norm() >= kMergeDistance) append(points, p);
  };
  add_if_far(from.s_m, p_from);
  for (const Segment& segment : segments_of(line)) {
    if (segment.s_m > from.s_m && segment.s_m < to.s_m) append(points, segment.from);
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

void add_edges(const DriftLine& line, std::vector<Split> splits, DriftGraph& graph) {
  std::stable_sort(splits.begin(), splits.end(),
                   [](const Split& a, const Split& b) { return a.s_m < b.s_m; });
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
  const std::vector<std::vector<Split>> splits = Splitter(drifts).splits();
  for (std::size_t i = 0; i < drifts.size(); ++i) add_edges(drifts[i], splits[i], graph);
  for (const DriftLine& drift : drifts) {
    if (!drift.entrance) continue;
    const int node = node_at(drift.points.front(), graph.nodes);
    graph.nodes[static_cast<std::size_t>(node)].entrance = true;
  }
  return graph;
}

}  // namespace adit
