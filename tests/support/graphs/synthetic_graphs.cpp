// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/graphs/synthetic_graphs.hpp"

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <random>
#include <stdexcept>

namespace adit::test {
namespace {

class MeasurementNoise {
 public:
  MeasurementNoise(double noise, std::uint32_t seed) : noise_(noise), rng_(seed) {}

  PoseConstraint measure(const PoseGraph& graph, int from, int to) {
    const Pose2 truth = between(graph.poses[static_cast<std::size_t>(from)],
                                graph.poses[static_cast<std::size_t>(to)]);
    const Pose2 error{noise_ * number(), noise_ * number(), 0.1 * noise_ * number()};
    Eigen::Matrix3d A;
    A << 1.0, number(), number(), 0.0, 1.0, number(), 0.0, 0.0, 1.0;
    const Eigen::Vector3d scale(100.0, 50.0, 4000.0);
    return {from, to, truth * error, A.transpose() * scale.asDiagonal() * A};
  }

 private:
  /// Triangular distribution from −1 to 1. Computed from the integers of the generator because the
  /// distributions of the standard library differ between implementations.
  double number() {
    const auto uniform = [this] { return static_cast<double>(rng_()) / 4294967295.0; };
    const double a = uniform();
    return a - uniform();
  }

  double noise_;
  std::mt19937 rng_;
};

}  // namespace

PoseGraph square_trajectory_graph(int nodes, int side, double noise, std::uint32_t seed) {
  PoseGraph graph;
  MeasurementNoise noisy(noise, seed);
  Pose2 T_map_node;
  for (int i = 0; i < nodes; ++i) {
    graph.poses.push_back(T_map_node);
    const bool corner = (i + 1) % side == 0;
    T_map_node = T_map_node * Pose2{1.0, 0.0, corner ? std::numbers::pi / 2.0 : 0.0};
    if (i > 0) graph.constraints.push_back(noisy.measure(graph, i - 1, i));
    const int before = i - 4 * side;
    if (before >= 0) graph.constraints.push_back(noisy.measure(graph, before, i));
  }
  return graph;
}

namespace {

constexpr double kWrongMin = 3.0;  // [m]
constexpr int kGroup = 20;
constexpr int kApart = 2 * kGroup;  // in node indices, so that a group does not overlap itself
constexpr std::size_t kPosesMin = 160;

class WrongLoopGenerator {
 public:
  WrongLoopGenerator(const PoseGraph& graph, std::uint32_t seed) : graph_(graph), rng_(seed) {
    for (const PoseConstraint& c : graph.constraints) {
      if (is_loop(c)) information_.push_back(c.information);
    }
    if (information_.empty() || graph.poses.size() < kPosesMin) {
      throw std::invalid_argument("the graph has no loop closures or too few poses");
    }
  }

  /// Constraints from a + k to b + k for k < `length`, consistent with node b being near node a.
  std::vector<PoseConstraint> make_group(int length) {
    while (true) {
      const int a = below(static_cast<int>(graph_.poses.size()) - kGroup);
      const int b = below(static_cast<int>(graph_.poses.size()) - kGroup);
      const Pose2 claim{2.0 * random_number() - 1.0, 2.0 * random_number() - 1.0,
                        std::numbers::pi * (2.0 * random_number() - 1.0)};
      if (std::abs(a - b) < kApart) continue;
      std::vector<PoseConstraint> loops;
      for (int k = 0; k < length; ++k) {
        const Pose2 T_from_to =
            between(pose(a), pose(a + k)).inverse() * claim * between(pose(b), pose(b + k));
        loops.push_back({a + k, b + k, T_from_to, drawn_information()});
      }
      if (std::all_of(loops.begin(), loops.end(), [this](const auto& c) { return is_wrong(c); })) {
        return loops;
      }
    }
  }

 private:
  [[nodiscard]] const Pose2& pose(int node) const {
    return graph_.poses[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] bool is_wrong(const PoseConstraint& c) const {
    const Pose2 truth = between(pose(c.from), pose(c.to));
    return (truth.translation() - c.T_from_to.translation()).norm() > kWrongMin;
  }
  double random_number() { return static_cast<double>(rng_()) / 4294967296.0; }
  int below(int n) { return static_cast<int>(random_number() * n); }
  const Eigen::Matrix3d& drawn_information() {
    return information_[static_cast<std::size_t>(below(static_cast<int>(information_.size())))];
  }

  const PoseGraph& graph_;
  std::vector<Eigen::Matrix3d> information_;
  std::mt19937 rng_;
};

std::vector<PoseConstraint> wrong_loops(const PoseGraph& graph, int count, int group,
                                        std::uint32_t seed) {
  WrongLoopGenerator generator(graph, seed);
  std::vector<PoseConstraint> loops;
  while (static_cast<int>(loops.size()) < count) {
    const auto more = generator.make_group(std::min(group, count - static_cast<int>(loops.size())));
    loops.insert(loops.end(), more.begin(), more.end());
  }
  return loops;
}

}  // namespace

bool is_loop(const PoseConstraint& constraint) {
  return std::abs(constraint.to - constraint.from) != 1;
}

std::vector<PoseConstraint> random_wrong_loops(const PoseGraph& graph, int count,
                                               std::uint32_t seed) {
  return wrong_loops(graph, count, 1, seed);
}

std::vector<PoseConstraint> consistent_wrong_loops(const PoseGraph& graph, int count,
                                                   std::uint32_t seed) {
  return wrong_loops(graph, count, kGroup, seed);
}

}  // namespace adit::test
