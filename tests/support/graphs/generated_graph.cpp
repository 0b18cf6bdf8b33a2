// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/graphs/generated_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>

#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/pose_graph.hpp"

namespace adit::test {
namespace {

constexpr double kLoopReachM = 2.5;
constexpr int kLoopApart = 20;  // in poses
constexpr double kLoopM = 0.05;
constexpr double kLoopRad = 0.01;
constexpr double kWrongMinM = 3.0;
constexpr int kGroupLength = 20;
constexpr int kTunnelLength = 100;
constexpr int kBlockM = 10;
constexpr int kFailuresMax = 20000;
constexpr double kStepMin = 0.005;  // of the standard deviation that a step claims [m]

std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

/// Computed from the integers of the generator because the distributions of the standard library
/// differ between implementations.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint32_t seed) : rng_(seed) {}

  double uniform() { return (static_cast<double>(rng_()) + 0.5) / 4294967296.0; }
  int below(int n) { return std::min(n - 1, static_cast<int>(uniform() * n)); }
  double normal() {
    return std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * std::numbers::pi * uniform());
  }
  Pose2 error(double m, double rad) { return {m * normal(), m * normal(), rad * normal()}; }

 private:
  std::mt19937 rng_;
};

/// The true poses of a drive, a metre apart.
class Drive {
 public:
  explicit Drive(std::size_t poses) : poses_(poses) {}

  [[nodiscard]] bool is_complete() const { return truth_.size() >= poses_; }
  void forward(int steps) {
    for (int i = 0; i < steps && !is_complete(); ++i) {
      truth_.push_back(pose_);
      pose_ = pose_ * Pose2{1.0, 0.0, 0.0};
    }
  }
  void turn(double angle) { pose_.theta = wrap_angle(pose_.theta + angle); }
  void arc(double radius_m, int steps) {
    const double angle = 1.0 / radius_m;
    for (int i = 0; i < steps && !is_complete(); ++i) {
      truth_.push_back(pose_);
      pose_ = pose_ * Pose2{1.0, 0.0, angle};
    }
  }
  [[nodiscard]] const Pose2& pose() const { return pose_; }
  [[nodiscard]] std::vector<Pose2> take() { return std::move(truth_); }

 private:
  std::size_t poses_;
  Pose2 pose_;
  std::vector<Pose2> truth_;
};

std::vector<Pose2> drive_through_grid(int poses, RandomNumbers& random) {
  const double extent = 0.5 * std::sqrt(static_cast<double>(poses)) + 2.0 * kBlockM;
  Drive drive(as_index(poses));
  while (!drive.is_complete()) {
    drive.forward(kBlockM);
    const int choice = random.below(4);
    if (choice < 2) drive.turn((choice == 0 ? 1.0 : -1.0) * std::numbers::pi / 2.0);
    const Eigen::Vector2d next = drive.pose() * Eigen::Vector2d(kBlockM, 0.0);
    if (next.cwiseAbs().maxCoeff() > extent) drive.turn(std::numbers::pi);
  }
  return drive.take();
}

std::vector<Pose2> drive_through_rings(int poses, RandomNumbers& random) {
  Drive drive(as_index(poses));
  while (!drive.is_complete()) {
    const int circumference = 40 + random.below(200);
    const double side = random.below(2) == 0 ? 1.0 : -1.0;
    const double radius_m = side * circumference / (2.0 * std::numbers::pi);
    drive.arc(radius_m, circumference * (1 + random.below(3)) + random.below(circumference));
  }
  return drive.take();
}

/// Whether the next metre ahead is outside a rectangle that begins at the origin.
bool leaves(const Pose2& pose, double length_m, double width_m) {
  const Eigen::Vector2d next = pose * Eigen::Vector2d(1.0, 0.0);
  return next.x() < -0.5 || next.y() < -0.5 || next.x() > length_m + 0.5 ||
         next.y() > width_m + 0.5;
}

/// Along parallel entries, straight on for the most part, through crosscuts, and back at the ends.
std::vector<Pose2> drive_through_mine(int poses, RandomNumbers& random) {
  constexpr int kEntriesApartM = 12;
  constexpr int kCrosscutsApartM = 24;
  Drive drive(as_index(poses));
  const double width_m = kEntriesApartM * (2.0 + random.below(4));
  const double length_m = kCrosscutsApartM * (3.0 + poses / 300);
  while (!drive.is_complete()) {
    const bool along = std::abs(std::cos(drive.pose().theta)) > 0.5;
    drive.forward(along ? kCrosscutsApartM : kEntriesApartM);
    if (random.uniform() > (along ? 0.7 : 0.3)) {
      drive.turn((random.below(2) == 0 ? 1.0 : -1.0) * std::numbers::pi / 2.0);
    }
    for (int i = 0; i < 4 && leaves(drive.pose(), length_m, width_m); ++i) {
      drive.turn(std::numbers::pi / 2.0);
    }
  }
  return drive.take();
}

std::vector<Pose2> drive_through(const GraphScenario& scenario, RandomNumbers& random) {
  switch (scenario.world) {
    case GraphWorld::kRings:
      return drive_through_rings(scenario.poses, random);
    case GraphWorld::kMine:
      return drive_through_mine(scenario.poses, random);
    default:
      return drive_through_grid(scenario.poses, random);
  }
}

Eigen::Matrix3d information_of(double m, double rad) {
  return Eigen::Vector3d(1.0 / (m * m), 1.0 / (m * m), 1.0 / (rad * rad)).asDiagonal();
}

class GraphGenerator {
 public:
  explicit GraphGenerator(const GraphScenario& scenario)
      : scenario_(scenario), random_(scenario.seed) {}

  LabelledGraph run() {
    result_.truth = drive_through(scenario_, random_);
    for (int i = 0; i < poses(); ++i) result_.true_nodes.push_back(i);
    result_.graph.poses = result_.truth;
    add_odometry();
    const int right = add_right();
    add_wrong(static_cast<int>(right * scenario_.wrong_share / (1.0 - scenario_.wrong_share)));
    chain_odometry(result_.graph);
    return std::move(result_);
  }

 private:
  [[nodiscard]] int poses() const { return static_cast<int>(result_.truth.size()); }
  [[nodiscard]] const Pose2& truth(int i) const { return result_.truth[as_index(i)]; }

  void add(int from, int to, const Pose2& T_from_to, const Eigen::Matrix3d& information,
           LoopLabel label) {
    result_.graph.constraints.push_back({from, to, T_from_to, information});
    result_.labels.push_back(label);
  }

  void add_odometry() {
    const double m = std::max(scenario_.drift, kStepMin);
    for (int i = 0; i + 1 < poses(); ++i) {
      const Pose2 error = random_.error(scenario_.drift, 0.1 * scenario_.drift);
      add(i, i + 1, between(truth(i), truth(i + 1)) * error, information_of(m, 0.1 * m),
          LoopLabel::kNone);
    }
  }

  int add_right() {
    using Cell = std::array<int, 2>;
    const auto cell_of = [&](int i) -> Cell {
      return {static_cast<int>(std::floor(truth(i).x / kLoopReachM)),
              static_cast<int>(std::floor(truth(i).y / kLoopReachM))};
    };
    std::map<Cell, std::vector<int>> cells;
    std::vector<std::array<int, 2>> pairs;
    for (int i = 0; i < poses(); ++i) {
      const Cell cell = cell_of(i);
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          for (const int j : cells[{cell[0] + dx, cell[1] + dy}]) {
            const double apart_m = (truth(i).translation() - truth(j).translation()).norm();
            if (i - j > kLoopApart && apart_m < kLoopReachM) pairs.push_back({j, i});
          }
        }
      }
      cells[cell].push_back(i);
    }
    const int count = std::min<int>(scenario_.right, static_cast<int>(pairs.size()));
    for (int k = 0; k < count; ++k) {
      const auto last = static_cast<int>(pairs.size()) - k;
      std::swap(pairs[as_index(k)], pairs[as_index(k + random_.below(last))]);
      const auto [j, i] = pairs[as_index(k)];
      add(j, i, between(truth(j), truth(i)) * random_.error(kLoopM, kLoopRad),
          information_of(kLoopM, kLoopRad), LoopLabel::kRight);
    }
    return count;
  }

  void add_wrong(int count) {
    int failures = 0;
    while (count > 0 && failures < kFailuresMax) {
      const int added = add_wrong_group(count);
      failures += added == 0 ? 1 : 0;
      count -= added;
    }
  }

  /// Links sections as if they were one. Returns the number of loops.
  int add_wrong_group(int most) {
    const int length = scenario_.wrong == WrongLoops::kRandom   ? 1
                       : scenario_.wrong == WrongLoops::kGroups ? kGroupLength
                                                                : kTunnelLength;
    const bool parallel = scenario_.wrong == WrongLoops::kParallel;
    const int shortest = parallel ? kGroupLength : length;
    const int steps =
        std::min({shortest + random_.below(length - shortest + 1), most, poses() / 4});
    const int a = random_.below(poses() - steps);
    const int b = random_.below(poses() - steps);
    if (b - a <= 2 * steps + kLoopApart) return 0;
    Pose2 claim = random_.error(0.5, 0.05);
    if (scenario_.wrong == WrongLoops::kRandom)
      claim.theta = 2.0 * std::numbers::pi * random_.uniform();
    if (parallel && !look_alike(a, b, steps)) return 0;
    std::vector<PoseConstraint> loops;
    for (int k = 0; k < steps; ++k) {
      const Pose2 T_from_to =
          between(truth(a), truth(a + k)).inverse() * claim * between(truth(b), truth(b + k));
      const Pose2 actual = between(truth(a + k), truth(b + k));
      if ((T_from_to.translation() - actual.translation()).norm() < kWrongMinM) return 0;
      loops.push_back({a + k, b + k, T_from_to * random_.error(kLoopM, kLoopRad),
                       information_of(kLoopM, kLoopRad)});
    }
    for (const PoseConstraint& c : loops) {
      add(c.from, c.to, c.T_from_to, c.information, LoopLabel::kWrong);
    }
    return steps;
  }

  /// Whether two sections have the same shape.
  [[nodiscard]] bool look_alike(int a, int b, int steps) const {
    for (int k = 0; k < steps; ++k) {
      const Pose2 difference =
          between(between(truth(a), truth(a + k)), between(truth(b), truth(b + k)));
      if (difference.translation().norm() > 0.5 || std::abs(difference.theta) > 0.1) return false;
    }
    return true;
  }

  GraphScenario scenario_;
  RandomNumbers random_;
  LabelledGraph result_;
};

}  // namespace

GraphScenario random_scenario(std::uint32_t seed) {
  RandomNumbers random(seed * 2654435761U + 17U);
  GraphScenario scenario;
  scenario.world = static_cast<GraphWorld>(random.below(3));
  scenario.wrong = static_cast<WrongLoops>(random.below(3));
  scenario.poses = 300 + random.below(1700);
  scenario.right = scenario.poses / 4 + random.below(scenario.poses);
  scenario.drift = 0.002 * std::pow(100.0, random.uniform());
  scenario.wrong_share = 0.05 + 0.75 * random.uniform();
  scenario.seed = seed;
  return scenario;
}

std::string text(GraphWorld world) {
  switch (world) {
    case GraphWorld::kGrid:
      return "grid";
    case GraphWorld::kRings:
      return "rings";
    default:
      return "mine";
  }
}

std::string text(WrongLoops wrong) {
  switch (wrong) {
    case WrongLoops::kRandom:
      return "at random";
    case WrongLoops::kGroups:
      return "in groups";
    default:
      return "parallel tunnels";
  }
}

LabelledGraph generated_graph(const GraphScenario& scenario) {
  return GraphGenerator(scenario).run();
}

void lose_heading(LabelledGraph& labelled, std::uint32_t seed) {
  constexpr double kStepM = 0.05;
  constexpr double kStepRad = 0.2;
  RandomNumbers random(seed);
  for (std::size_t k = 0; k < labelled.labels.size(); ++k) {
    if (labelled.labels[k] != LoopLabel::kNone) continue;
    PoseConstraint& c = labelled.graph.constraints[k];
    const Pose2 T_from_to =
        between(labelled.truth[as_index(c.from)], labelled.truth[as_index(c.to)]);
    c.T_from_to = T_from_to * random.error(kStepM, kStepRad);
    c.information = Eigen::Vector3d(1.0 / (kStepM * kStepM), 1.0 / (kStepM * kStepM),
                                    1.0 / (kStepRad * kStepRad))
                        .asDiagonal();
  }
  chain_odometry(labelled.graph);
}

}  // namespace adit::test
