// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/traverse/traverse.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/tools/survey/survey_scene.hpp"

namespace adit {
namespace {

constexpr double kStepSdM = 0.01;
constexpr double kTurnSdRad = 0.001;

Eigen::Matrix3d information(double place_sd_m, double turn_sd_rad) {
  return Eigen::Vector3d(1.0 / (place_sd_m * place_sd_m), 1.0 / (place_sd_m * place_sd_m),
                         1.0 / (turn_sd_rad * turn_sd_rad))
      .asDiagonal();
}

/// A square of 20 m: 5 steps of 4 m along each side, a loop closure from the last local map to the
/// first one that finds the traverse off by 0.1 m along x. The loop closure is stored in either
/// order.
MapGraph square(bool reversed) {
  MapGraph graph;
  graph.poses.emplace_back();
  Pose2 T;
  for (int i = 1; i <= 20; ++i) {
    const Pose2 step(4.0, 0.0, i % 5 == 0 ? std::numbers::pi / 2.0 : 0.0);
    T = T * step;
    graph.poses.push_back(T);
    graph.constraints.push_back(
        {{i - 1, i, step, information(kStepSdM, kTurnSdRad)}, MapConstraint::Kind::kSequential});
  }
  const Pose2 loop_closure(-0.1, 0.0, 0.0);  // the traverse says 0
  PoseConstraint measured{0, 20, loop_closure, information(0.02, 0.002)};
  if (reversed) measured = {20, 0, loop_closure.inverse(), information(0.02, 0.002)};
  graph.constraints.push_back({measured, MapConstraint::Kind::kLoopClosure});
  return graph;
}

TEST(Traverse, HasTheMisclosureOfALoop) {
  for (const bool reversed : {false, true}) {
    const auto loops = traverse_loops(square(reversed));
    ASSERT_EQ(loops.size(), 1U);
    EXPECT_EQ(loops[0].from, 0);
    EXPECT_EQ(loops[0].to, 20);
    EXPECT_NEAR(loops[0].length_m, 80.0, 1e-9);
    EXPECT_NEAR(loops[0].misclosure_m, 0.1, 1e-9);
    EXPECT_NEAR(loops[0].misclosure_rad, 0.0, 1e-9);
    // Each step moves the end, which is at the origin, by its own error and by its turn about
    // itself.
    Eigen::Matrix3d covariance = information(0.02, 0.002).inverse();
    for (const Pose2& step : square(false).poses) {
      if (step == Pose2{}) continue;  // the first local map
      Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
      J(0, 2) = step.y;
      J(1, 2) = -step.x;
      covariance += J * information(kStepSdM, kTurnSdRad).inverse() * J.transpose();
    }
    const double expected = 0.1 * 0.1 * covariance.inverse()(0, 0);
    EXPECT_NEAR(loops[0].chi2, expected, 0.01 * expected);
  }
}

TEST(Traverse, LeavesOutLoopsWithoutATraverse) {
  MapGraph graph = square(false);
  graph.constraints.erase(graph.constraints.begin() + 7);  // another session
  EXPECT_TRUE(traverse_loops(graph).empty());
}

TEST(Traverse, HasABudgetThatAddsUp) {
  const CloudStore clouds = test::stored({test::scan_of_tunnel(-3.0, 3.0)});
  const SurveyGraph stations = test::graph_along_x(1, 1.0);
  const RegisteredCloud cloud(clouds, stations);
  const auto budget = accuracy_budget(square(false), cloud);
  ASSERT_EQ(budget.size(), 5U);
  EXPECT_NEAR(budget[0].plan_sd_m, kRangeSdM, 1e-9);
  EXPECT_GT(budget[1].z_sd_m, 0.0);
  // The farthest station of the open traverse is as uncertain as its steps and turns make it.
  EXPECT_GT(budget[2].plan_sd_m, std::sqrt(10.0) * kStepSdM);
  EXPECT_LT(budget[2].plan_sd_m, 0.12);
  EXPECT_NEAR(budget[4].z_sd_m, std::hypot(budget[0].z_sd_m, budget[1].z_sd_m), 1e-9);
}

TEST(Traverse, HasEllipsesOfItsStations) {
  SurveyGraph::Node station;
  station.covariance(0, 0) = 0.04 * 0.04;
  station.covariance(1, 1) = 0.01 * 0.01;
  const Ellipse95 ellipse = ellipse_95(station);
  EXPECT_NEAR(ellipse.major_m, 0.0979, 1e-4);
  EXPECT_NEAR(ellipse.minor_m, 0.0245, 1e-4);
  EXPECT_NEAR(std::abs(ellipse.major_axis.x()), 1.0, 1e-9);
}

}  // namespace
}  // namespace adit
