// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/finished_graph/graph_odometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include "common/geometry/symmetric_eigen.hpp"
#include "common/pose_graph/normal_equations.hpp"
#include "procs/mapping/association/association_problem.hpp"

namespace adit {
namespace {

constexpr double kSingular = 1e-9;                 // relative to the largest eigenvalue
constexpr double kTunnelWidthM = 1.0;              // of a map that is a straight line
constexpr std::size_t kBridgeCandidatesMax = 100;  // between two parts, compared with each other

/// Whether the information has full rank.
bool determines(const PoseConstraint& c) {
  const Eigen::Vector3d eigenvalues = symmetric_eigen(c.information).values;
  return eigenvalues.minCoeff() > kSingular * eigenvalues.maxCoeff();
}

int span(const PoseConstraint& c) { return std::abs(c.to - c.from); }

/// A constraint between two parts of the odometry. Better ones come first.
struct Bridge {
  bool is_singular = false;
  int unsupported = 0;  ///< minus the number of others between these parts that agree with it
  int span = 0;
  int constraint = -1;
  std::array<int, 2> parts{};

  [[nodiscard]] auto rank() const { return std::tuple(is_singular, unsupported, span, constraint); }
};

/// Links the parts of an odometry with gaps.
class GapBridging {
 public:
  GapBridging(const PoseGraph& graph, const std::vector<int>& chain, double gate)
      : graph_(graph), gate_(gate) {
    part_.push_back(0);
    within_.add_map({});
    for (const int k : chain) {
      part_.push_back(part_.back() + (k < 0 ? 1 : 0));
      within_.add_map(k < 0 ? UncertainPose{} : measured(k));
    }
    const double length_m = chain.empty() ? 0.0 : within_.length_m(within_.maps() - 1);
    area_m2_ = std::max(within_.area_m2(), kTunnelWidthM * length_m);
  }

  /// The tree that links all parts (Kruskal 1956).
  [[nodiscard]] std::vector<int> bridges() {
    std::vector<Bridge> candidates = best_between_parts();
    std::ranges::sort(candidates, {}, [](const Bridge& b) { return b.rank(); });
    std::vector<int> set(static_cast<std::size_t>(part_.back()) + 1);
    std::iota(set.begin(), set.end(), 0);
    const auto root = [&](int part) {
      while (set[as_index(part)] != part) {
        part = set[as_index(part)] = set[as_index(set[as_index(part)])];
      }
      return part;
    };
    links_.resize(set.size());
    std::vector<int> bridges;
    for (const Bridge& b : candidates) {
      const int first = root(b.parts[0]);
      const int second = root(b.parts[1]);
      if (first == second) continue;
      set[as_index(second)] = first;
      links_[as_index(b.parts[0])].push_back(b.constraint);
      links_[as_index(b.parts[1])].push_back(b.constraint);
      bridges.push_back(b.constraint);
    }
    return bridges;
  }

  /// The displacement from a pose to the next, along the bridges found.
  [[nodiscard]] UncertainPose over_gap(int pose) const {
    UncertainPose T_pose_here;
    int here = pose;
    for (const int k : path(part_[as_index(pose)], part_[as_index(pose) + 1])) {
      const PoseConstraint bridge = forward(graph_.constraints[as_index(k)]);
      const bool ahead = part_[as_index(bridge.from)] == part_[as_index(here)];
      const UncertainPose T_from_to = measured_by(bridge);
      T_pose_here = T_pose_here * within_.between(here, ahead ? bridge.from : bridge.to) *
                    (ahead ? T_from_to : inverse(T_from_to));
      here = ahead ? bridge.to : bridge.from;
    }
    return T_pose_here * within_.between(here, pose + 1);
  }

 private:
  [[nodiscard]] UncertainPose measured(int k) const {
    return measured_by(forward(graph_.constraints[as_index(k)]));
  }

  /// The best bridge between each two parts that have one.
  [[nodiscard]] std::vector<Bridge> best_between_parts() const {
    std::map<std::array<int, 2>, std::vector<int>> between_parts;
    for (int k = 0; k < static_cast<int>(graph_.constraints.size()); ++k) {
      const PoseConstraint& c = graph_.constraints[as_index(k)];
      const auto [first, second] = std::minmax(part_[as_index(c.from)], part_[as_index(c.to)]);
      if (first != second) between_parts[{first, second}].push_back(k);
    }
    std::vector<Bridge> best;
    for (auto& [parts, constraints] : between_parts) {
      best.push_back(best_of(std::move(constraints), parts));
    }
    return best;
  }

  [[nodiscard]] Bridge best_of(std::vector<int> constraints,
                               const std::array<int, 2>& parts) const {
    const auto constraint = [&](int k) { return graph_.constraints[as_index(k)]; };
    std::ranges::stable_sort(constraints, {}, [&](int k) { return span(constraint(k)); });
    if (constraints.size() > kBridgeCandidatesMax) constraints.resize(kBridgeCandidatesMax);
    std::vector<Bridge> candidates;
    for (const int k : constraints) {
      const auto supporting = std::ranges::count_if(constraints, [&](int other) {
        return other != k && support(constraint(k), constraint(other));
      });
      candidates.push_back({!determines(constraint(k)), -static_cast<int>(supporting),
                            span(constraint(k)), k, parts});
    }
    return *std::ranges::min_element(candidates, {}, [](const Bridge& b) { return b.rank(); });
  }

  /// Whether two constraints between the same parts agree, and would hardly do so by chance.
  [[nodiscard]] bool support(const PoseConstraint& a, const PoseConstraint& b) const {
    const CycleResidual cycle = cycle_residual(within_, forward(a), forward(b));
    return cycle.disagreement < gate_ &&
           chance_of_fit(cycle.covariance, gate_, area_m2_) < kChanceMax;
  }

  /// The bridges from one part to another, in order.
  [[nodiscard]] std::vector<int> path(int from, int to) const {
    std::vector<int> reached_by(links_.size(), -1);
    std::queue<int> queue({to});
    while (!queue.empty() && queue.front() != from) {
      const int part = queue.front();
      queue.pop();
      for (const int k : links_[as_index(part)]) {
        const int next = other_part(k, part);
        if (next == to || reached_by[as_index(next)] >= 0) continue;
        reached_by[as_index(next)] = k;
        queue.push(next);
      }
    }
    std::vector<int> path;
    for (int part = from; part != to; part = other_part(path.back(), part)) {
      path.push_back(reached_by[as_index(part)]);
    }
    return path;
  }

  [[nodiscard]] int other_part(int k, int part) const {
    const PoseConstraint& c = graph_.constraints[as_index(k)];
    return part_[as_index(c.from)] + part_[as_index(c.to)] - part;
  }

  const PoseGraph& graph_;
  double gate_;
  double area_m2_ = 0.0;
  std::vector<int> part_;                // of each pose
  OdometryChain within_;                 // valid between poses of the same part
  std::vector<std::vector<int>> links_;  // bridges of each part
};

}  // namespace

PoseConstraint forward(const PoseConstraint& c) {
  if (c.from < c.to) return c;
  const Eigen::Matrix3d Ad = adjoint(c.T_from_to.inverse());
  return {c.to, c.from, c.T_from_to.inverse(), Ad.transpose() * c.information * Ad};
}

GraphOdometry::GraphOdometry(const PoseGraph& graph, double gate) {
  if (const auto node = first_unconnected_node(graph)) {
    throw std::invalid_argument(fmt::format("no chain of constraints links pose {}", *node));
  }
  chain.assign(graph.poses.empty() ? 0 : graph.poses.size() - 1, -1);
  std::vector<bool> is_certain(graph.constraints.size(), false);
  for (int k = 0; k < static_cast<int>(graph.constraints.size()); ++k) {
    const PoseConstraint& c = graph.constraints[as_index(k)];
    if (span(c) != 1) continue;
    int& slot = chain[as_index(std::min(c.from, c.to))];
    if (slot >= 0 || !determines(c)) continue;
    slot = k;
    is_certain[as_index(k)] = true;
  }
  GapBridging bridging(graph, chain, gate);
  if (std::ranges::count(chain, -1) > 0) bridges = bridging.bridges();
  for (const int k : bridges) is_certain[as_index(k)] = true;
  for (int i = 0; i < static_cast<int>(chain.size()); ++i) {
    const int k = chain[as_index(i)];
    steps.push_back(k < 0 ? bridging.over_gap(i)
                          : measured_by(forward(graph.constraints[as_index(k)])));
  }
  for (int k = 0; k < static_cast<int>(graph.constraints.size()); ++k) {
    if (!is_certain[as_index(k)]) loops.push_back(k);
  }
  std::ranges::stable_sort(loops, {}, [&](int k) {
    const PoseConstraint& c = graph.constraints[as_index(k)];
    return std::max(c.from, c.to);
  });
}

}  // namespace adit
