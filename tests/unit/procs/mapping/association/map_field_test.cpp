// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/map_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/trial.hpp"
#include "tests/unit/procs/mapping/association/ring_walk.hpp"

namespace adit {
namespace {

constexpr int kMaps = 600;
// Of maps that are within 1 mm and 0.1 mrad of their linearisation.
constexpr double kOptimumM = 5e-4;

class MapFieldOfSeed : public testing::TestWithParam<std::uint32_t> {
 protected:
  MapFieldOfSeed() : walk_(kMaps, GetParam()), random_(GetParam()) {}

  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint32_t>(n)); }

  void add_map() {
    const int map = problem_.odometry.maps();
    if (map > 0) {
      const PoseConstraint& step = walk_.chain[as_index(map - 1)];
      problem_.chain.push_back(step);
      problem_.odometry.add_map(measured_by(step));
      hypothesis_.T_map_local.push_back(hypothesis_.T_map_local.back() * step.T_from_to);
    } else {
      problem_.odometry.add_map({});
      hypothesis_.T_map_local.emplace_back();
    }
  }

  /// From the newest map; undecided.
  void add_loop_closure() {
    const int newer = problem_.odometry.maps() - 1;
    if (newer < test::RingWalk::kRound) return;
    LoopClosure added = walk_.loop_closure(newer - test::RingWalk::kRound, newer);
    added.id = static_cast<int>(problem_.loop_closures.size());
    problem_.add_to_group(problem_.group_count());
    problem_.plausible.push_back(true);
    problem_.loop_closures.push_back(std::move(added));
    hypothesis_.chosen.push_back(Association::kNone);
  }

  void change_decision() {
    if (hypothesis_.chosen.empty()) return;
    int& chosen = hypothesis_.chosen[as_index(below(static_cast<int>(hypothesis_.chosen.size())))];
    chosen = chosen == 0 ? Association::kNone : 0;
  }

  void roll_back(int maps) {
    AssociationProblem::Checkpoint checkpoint{maps, 0, 0};
    for (const LoopClosure& c : problem_.loop_closures) {
      checkpoint.loop_closures += c.newer_map < maps ? 1 : 0;
    }
    checkpoint.group_count = static_cast<int>(checkpoint.loop_closures);
    problem_.roll_back(checkpoint);
    hypothesis_.chosen.resize(checkpoint.loop_closures);
    hypothesis_.T_map_local.resize(as_index(maps));
    field_.truncate(maps, checkpoint.loop_closures);
  }

  void follow() {
    field_.follow(problem_, hypothesis_);
    for (int step = 0; step < 30 && field_.relinearise(); ++step) {
    }
    hypothesis_.T_map_local = field_.poses();
  }

  void expect_the_optimum() const {
    PoseGraph graph = graph_of(problem_, hypothesis_);
    OptimizeParams params;
    params.tolerance = 1e-14;
    const OptimizeResult optimum = optimize(graph, params);
    for (std::size_t map = 0; map < graph.poses.size(); ++map) {
      const Eigen::Vector3d error = between(graph.poses[map], field_.poses()[map]).vector();
      ASSERT_LT(error.norm(), kOptimumM) << "map " << map << " of " << graph.poses.size();
    }
    EXPECT_NEAR(field_.field().objective(), optimum.objective, 1e-5 * (1.0 + optimum.objective));
  }

  test::RingWalk walk_;
  std::mt19937 random_;
  AssociationProblem problem_;
  Hypothesis hypothesis_;
  MapField field_;
};

INSTANTIATE_TEST_SUITE_P(Seeds, MapFieldOfSeed, testing::Range(1U, 5U));

TEST_P(MapFieldOfSeed, HasTheOptimumOfAllMapsAfterAnyDecisions) {
  while (problem_.odometry.maps() < kMaps) {
    for (int added = 1 + below(12); added > 0 && problem_.odometry.maps() < kMaps; --added) {
      add_map();
      if (below(4) == 0) add_loop_closure();
      if (below(3) == 0) follow();
    }
    if (below(2) == 0) change_decision();
    const int maps = problem_.odometry.maps();
    if (below(6) == 0 && maps > 20) roll_back(maps - below(8));
    follow();
    if (maps % 5 == 0) expect_the_optimum();
    if (HasFatalFailure()) return;
  }
  expect_the_optimum();
}

TEST_P(MapFieldOfSeed, FindsAllMapsThatMayBeNear) {
  while (problem_.odometry.maps() < kMaps) {
    add_map();
    if (below(10) == 0) add_loop_closure();
    if (below(20) == 0) change_decision();
  }
  follow();
  Trial trial(problem_, hypothesis_, field_);
  Trial batch(problem_, hypothesis_);
  constexpr double kSigmas = 3.0;
  const std::vector<double> reach_m(as_index(kMaps), 2.0);
  for (const int map : {kMaps - 1, kMaps / 2}) {
    const std::vector<NearMap> near = trial.near_maps(map, reach_m, kSigmas);
    const std::vector<Eigen::Matrix3d> covariances = batch.covariances_to(map);
    auto next = near.begin();
    int expected = 0;
    for (int older = 0; older < map; ++older) {
      const Eigen::Matrix3d& covariance = covariances[as_index(older)];
      const Pose2 apart =
          between(hypothesis_.T_map_local[as_index(older)], hypothesis_.T_map_local[as_index(map)]);
      const double sd_m = std::sqrt(covariance(0, 0) + covariance(1, 1));
      const bool is_near = apart.translation().norm() < 4.0 + kSigmas * sd_m - 1e-6;
      expected += is_near ? 1 : 0;
      while (next != near.end() && next->older < older) ++next;
      const bool is_found = next != near.end() && next->older == older;
      ASSERT_TRUE(is_found || !is_near) << older;
      if (is_found) {
        EXPECT_LT((next->covariance - covariance).norm(), 1e-4 * covariance.norm()) << older;
      }
    }
    EXPECT_GT(expected, 5);
    EXPECT_LT(std::ssize(near), map);
    const auto least = std::ranges::min_element(
        covariances, {}, [](const Eigen::Matrix3d& c) { return c(0, 0) + c(1, 1); });
    EXPECT_LT((trial.least_covariance(map, map) - *least).norm(), 1e-4 * least->norm());
  }
}

}  // namespace
}  // namespace adit
