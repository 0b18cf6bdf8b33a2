// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scores/mission_score.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "common/geometry/attitude.hpp"
#include "sim/world/build_world.hpp"

namespace adit::test {
namespace {

constexpr double kFootM = 20.0;

/// A straight tunnel of 40 m with a grade of 10 m length, seen from x = 18 m.
MissionTruth truth_with_grade(double grade) {
  WorldDescription description;
  description.heights.floor_relief.height_m = 0.0;
  TunnelDescription main{"main", {0.0, 0.0, 40.0, 0.0}, 3.0, true};
  main.rise_m = {kFootM, 0.0, kFootM + 10.0, 10.0 * grade, kFootM + 20.0, 10.0 * grade};
  main.rise_grade = "sudden";
  description.plan.tunnels = {main};
  description.T_world_start = {3.0, 0.0, 0.0};
  return MissionTruth(build_world(description));
}

/// Of a mission that calls the tunnel blocked at a frontier this far from its begin.
int false_verdicts(const MissionTruth& truth, double frontier_x_m) {
  MissionLog log;
  for (int i = 0; i <= 100; ++i) {
    const TimedPose at{1'000'000 + 100'000 * std::int64_t{i}, {3.0 + 0.15 * i, 0.0, 0.0}};
    log.truth.push_back(at);
    log.mapped.push_back(at);
  }
  log.estimated = log.mapped;
  log.report.emplace();
  log.report->frontiers.resize(1);
  log.report->frontiers[0].p_map = {frontier_x_m, 0.0};
  log.report->frontiers[0].direction_map = {1.0, 0.0};
  log.verdicts.resize(1);
  log.verdicts[0].frontier = 0;
  const MissionScore score = truth.score(log);
  EXPECT_EQ(score.verdicts, 1);
  return score.false_verdicts;
}

TEST(MissionScore, ABlockageIsTrueAtAGradeThatIsTooSteep) {
  const MissionTruth truth = truth_with_grade(0.5);
  EXPECT_EQ(false_verdicts(truth, kFootM), 0);
  EXPECT_EQ(false_verdicts(truth, kFootM - 1.0), 0);  // its front wheels get onto the grade
  EXPECT_EQ(false_verdicts(truth, kFootM - 4.0), 1);  // and farther before it, it was not blocked
}

TEST(MissionScore, ABlockageIsFalseAtAGradeThatTheVehicleClimbs) {
  const MissionTruth truth = truth_with_grade(0.25);
  EXPECT_EQ(false_verdicts(truth, kFootM), 1);
  EXPECT_EQ(false_verdicts(truth, kFootM - 1.0), 1);
}

/// Under a roof of 0.85 m: Groundhog (1.0 m) does not get through, a vehicle of 0.5 m does.
TEST(MissionScore, ABlockageIsJudgedForTheVehicleOfTheMission) {
  WorldDescription description;
  description.plan.tunnels = {{"main", {0.0, 0.0, 40.0, 0.0}, 3.0, true}};
  description.T_world_start = {3.0, 0.0, 0.0};
  description.props.low_roofs = {{"low", "main", kFootM, kFootM + 5.0, 0.85}};
  const World world = build_world(description);
  Vehicle low;
  low.height_m = 0.5;
  EXPECT_EQ(false_verdicts(MissionTruth(world), kFootM - 1.0), 0);
  EXPECT_EQ(false_verdicts(MissionTruth(world, low), kFootM - 1.0), 1);
}

/// The constraints of a drive of 15 m, of which one is off by 0.4 m and one by 0.7 m.
TEST(MissionScore, MeasuresTheErrorOfLoopClosuresByTheTruth) {
  MissionLog log;
  for (int i = 0; i <= 100; ++i) {
    const std::int64_t utime = 1'000'000 + 100'000 * std::int64_t{i};
    log.truth.push_back({utime, {3.0 + 0.15 * i, 0.0, 0.3}});
    if (i % 20 == 0) log.local_map_utimes[i / 20] = utime;
  }
  const auto add = [&](MapConstraint::Kind kind, int from, int to, const Pose2& error) {
    const auto pose = [&](int map) {
      return *interpolate(log.truth, log.local_map_utimes.at(map));
    };
    log.graph.constraints.push_back(
        {{from, to, between(pose(from), pose(to)) * error, Eigen::Matrix3d::Identity()}, kind});
  };
  add(MapConstraint::Kind::kSequential, 0, 1, {5.0, 0.0, 0.0});
  add(MapConstraint::Kind::kLoopClosure, 0, 3, {0.0, 0.4, 0.1});
  add(MapConstraint::Kind::kLoopClosure, 1, 4, {0.7, 0.0, 0.0});
  const MissionScore score = truth_with_grade(0.0).score(log);
  EXPECT_NEAR(score.loop_closure_error_m, 0.7, 1e-9);
  EXPECT_EQ(score.wrong_loop_closures, 1U);
}

/// A smooth, level tunnel 3 m wide; Groundhog is 1.2 m wide and has its belly at 0.3 m.
double least_clearance_m(const std::vector<Eigen::Isometry3d>& bodies, double stone_m = 0.0) {
  WorldDescription description;
  description.heights.floor_relief.height_m = 0.0;
  description.heights.roof_relief.height_m = 0.0;
  description.wall_relief.height_m = 0.0;
  description.plan.tunnels = {{"main", {0.0, 0.0, 40.0, 0.0}, 3.0, true}};
  description.T_world_start = {3.0, 0.0, 0.0};
  if (stone_m > 0.0) {
    RubbleDescription stone;
    stone.tunnel = "main";
    stone.at_m = 10.0;
    stone.radius_m = 0.3;
    stone.height_m = stone_m;
    description.props.rubble = {stone};
  }
  MissionLog log;
  log.bodies = bodies;
  return MissionTruth(build_world(description)).score(log).least_clearance_m;
}

TEST(MissionScore, MeasuresTheLeastClearanceOfTheBody) {
  constexpr double kToleranceM = 0.01;
  const auto at = [](double x, double y, const Attitude& attitude = {}) {
    return in_space({x, y, 0.0}, 0.0, attitude);
  };
  EXPECT_EQ(least_clearance_m({at(5.0, 0.0)}), MissionScore::kClearanceMaxM);
  EXPECT_NEAR(least_clearance_m({at(5.0, 0.0), at(6.0, 0.8), at(7.0, -0.75)}), 0.1, kToleranceM);
  EXPECT_NEAR(least_clearance_m({at(5.0, 0.95)}), 0.0, kToleranceM);
  // Its front end 1.2 m ahead is lower by the pitch.
  EXPECT_NEAR(least_clearance_m({at(5.0, 0.0, {0.0, 0.15})}), 0.3 - 1.2 * std::sin(0.15), 0.03);
  EXPECT_EQ(least_clearance_m({at(5.0, 0.0)}, 0.25), MissionScore::kClearanceMaxM);
  const double above_m = least_clearance_m({at(5.0, 0.0), at(10.0, 0.0)}, 0.2);
  EXPECT_GT(above_m, 0.05);
  EXPECT_LT(above_m, 0.15);
}

}  // namespace
}  // namespace adit::test
