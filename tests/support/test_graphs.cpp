// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/test_graphs.hpp"

#include <numbers>
#include <random>

namespace adit::test {
namespace {

class Surveyor {
 public:
  Surveyor(double noise, std::uint32_t seed) : noise_(noise), rng_(seed) {}

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
  /// Sums and differences of the generator's integers are the same with every library; its
  /// distributions are not. From −1 to 1, near to the middle more often.
  double number() {
    const auto uniform = [this] { return static_cast<double>(rng_()) / 4294967295.0; };
    const double a = uniform();
    return a - uniform();
  }

  double noise_;
  std::mt19937 rng_;
};

}  // namespace

PoseGraph square_walk(int nodes, int side, double noise, std::uint32_t seed) {
  PoseGraph graph;
  Surveyor surveyor(noise, seed);
  Pose2 T_map_node;
  for (int i = 0; i < nodes; ++i) {
    graph.poses.push_back(T_map_node);
    const bool corner = (i + 1) % side == 0;
    T_map_node = T_map_node * Pose2{1.0, 0.0, corner ? std::numbers::pi / 2.0 : 0.0};
    if (i > 0) graph.constraints.push_back(surveyor.measure(graph, i - 1, i));
    const int before = i - 4 * side;
    if (before >= 0) graph.constraints.push_back(surveyor.measure(graph, before, i));
  }
  return graph;
}

}  // namespace adit::test
