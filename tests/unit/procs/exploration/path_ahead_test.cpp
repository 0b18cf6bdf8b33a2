// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The path ahead that exploration gives to the planner.
#include <algorithm>

#include <gtest/gtest.h>

#include "procs/exploration/exploration.hpp"
#include "tests/support/robots/exploring_robot.hpp"
#include "tests/unit/procs/exploration/test_mines.hpp"

namespace adit {
namespace {

constexpr double kLengthM = 12.0;
constexpr double kSpacingM = 0.3;

class PathAhead : public testing::Test {
 protected:
  PathAhead() { update_map(); }

  void update_map() {
    exploration_.add(robot_.last_map());
    exploration_.update(robot_.graph());
  }
  std::vector<Eigen::Vector2d> path(bool returning_home) {
    exploration_.decide({robot_.utime(), robot_.T_map_body(), 2000.0, 0.0, returning_home});
    return exploration_.path_ahead(kLengthM, kSpacingM);
  }
  static double length_of(const std::vector<Eigen::Vector2d>& path) {
    double length_m = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double step_m = (path[i] - path[i - 1]).norm();
      EXPECT_LE(step_m, kSpacingM + 1e-9);
      length_m += step_m;
    }
    return length_m;
  }

  test::PlanarMine mine_ = tunnel_mine(junction());
  test::ExploringRobot robot_{mine_};
  Exploration exploration_{ExplorationParams{}};
};

TEST_F(PathAhead, BeginsAtTheRobotAndStaysInDrivableSpace) {
  for (int i = 0; i < 4; ++i) {
    const auto path = this->path(false);
    ASSERT_GT(path.size(), 2U);
    EXPECT_EQ(path.front(), robot_.T_map_body().translation());
    EXPECT_LE(length_of(path), kLengthM + 1e-9);
    for (std::size_t k = 0; k < path.size() / 2; ++k) {  // beyond a frontier the space is unknown
      EXPECT_TRUE(mine_.reachable(mine_.T_world_start * path[k]));
    }
    robot_.drive(path, 5.0);
    update_map();
  }
}

/// Whether a point lies where the map shows rock, or no room for the vehicle.
bool is_in_known_rock(const DrivableSpace& space, const Eigen::Vector2d& p_map) {
  const Eigen::Vector2i cell = space.cell_at(p_map);
  return space.known.get(cell, Occupancy::kUnseen) != Occupancy::kUnseen &&
         space.access.get(cell) == Access::kNone;
}

TEST(PathAheadInMines, LeadsThroughNoKnownRock) {
  for (const auto& tunnels : {junction(), crossroads(), ring(), rooms_and_pillars()}) {
    const test::PlanarMine mine = tunnel_mine(tunnels);
    test::ExploringRobot robot(mine);
    Exploration exploration{ExplorationParams{}};
    for (int i = 0; i < 60; ++i) {
      exploration.add(robot.last_map());
      exploration.update(robot.graph());
      const ExplorationDecision decision =
          exploration.decide({robot.utime(), robot.T_map_body(), 2000.0, 0.0, false});
      if (decision.kind == ExplorationDecision::Kind::kDone) break;
      const auto path = exploration.path_ahead(kLengthM, kSpacingM);
      EXPECT_TRUE(std::ranges::none_of(path, [&](const Eigen::Vector2d& p) {
        return is_in_known_rock(exploration.space(), p);
      })) << i;
      robot.drive(exploration.route(), 5.0);
    }
  }
}

/// The side tunnel leads back parallel to the main one.
TEST(PathAheadIntoAReturningSideTunnel, DoesNotLeadBackToTheRobot) {
  const test::PlanarMine mine = tunnel_mine({{0, 0, 30, 0}, {20, 0, 14, 14}});
  test::ExploringRobot robot(mine);
  Exploration exploration{ExplorationParams{}};
  int back = 0;
  for (int i = 0; i < 12; ++i) {
    exploration.add(robot.last_map());
    exploration.update(robot.graph());
    const Eigen::Vector2d p_robot = robot.T_map_body().translation();
    const ExplorationDecision decision =
        exploration.decide({robot.utime(), robot.T_map_body(), 2000.0, 0.0, false});
    const auto path = exploration.path_ahead(kLengthM, kSpacingM);
    if (path.size() < 2 || decision.frontier < 0) break;
    const Frontier frontier = exploration.frontiers()[static_cast<std::size_t>(decision.frontier)];
    const Eigen::Vector2d to_frontier = frontier.p_map - p_robot;
    if (to_frontier.norm() > 3.0 && decision.distance_m < kLengthM &&
        to_frontier.dot(frontier.direction_map) < 0.0) {
      ++back;
      EXPECT_NEAR((path.back() - frontier.p_map).norm(), 0.0, 0.5);  // within the smoothing
    }
    robot.drive(path, 2.0);
  }
  EXPECT_GT(back, 0);
}

TEST_F(PathAhead, EndsAtHome) {
  robot_.drive(path(false), 5.0);
  update_map();
  const auto home = path(true);
  ASSERT_GT(home.size(), 2U);
  EXPECT_NEAR(home.back().norm(), 0.0, 1e-9);
  EXPECT_NEAR(length_of(home), 5.0, 0.5);
}

/// Home around a corner, farther away than a scan reaches.
TEST(PathAheadFarFromHome, ReachesHomeAndIsTheSameWithinAScan) {
  const test::PlanarMine mine = tunnel_mine({{0, 0, 16, 0}, {16, 0, 16, 40}});
  test::ExploringRobot robot(mine);
  Exploration exploration{ExplorationParams{}};
  const auto decide = [&](bool returning_home) {
    exploration.add(robot.last_map());
    exploration.update(robot.graph());
    return exploration.decide({robot.utime(), robot.T_map_body(), 2000.0, 0.0, returning_home});
  };
  for (int i = 0; i < 20 && robot.T_map_body().translation().norm() < 18.0; ++i) {
    decide(false);
    robot.drive(exploration.path_ahead(12.0, kSpacingM), 3.0);
  }
  ASSERT_GT(decide(true).distance_m, 16.0);
  const auto near = exploration.path_ahead(12.0, kSpacingM);
  const auto far = exploration.path_ahead(36.0, kSpacingM);
  ASSERT_GT(far.size(), near.size());
  EXPECT_TRUE(std::equal(near.begin(), near.end(), far.begin(),
                         [](const auto& a, const auto& b) { return (a - b).norm() < 1e-9; }));
  EXPECT_NEAR(far.back().norm(), 0.0, 1e-9);
  for (std::size_t i = 1; i < far.size(); ++i)
    EXPECT_LE((far[i] - far[i - 1]).norm(), kSpacingM + 1e-9) << i;
  for (const Eigen::Vector2d& p : far) EXPECT_TRUE(mine.reachable(mine.T_world_start * p));
}

TEST_F(PathAhead, IsEmptyAtHome) { EXPECT_TRUE(path(true).empty()); }

TEST_F(PathAhead, IsEmptyWithoutAMap) {
  EXPECT_TRUE(Exploration(ExplorationParams{}).path_ahead(kLengthM, kSpacingM).empty());
}

}  // namespace
}  // namespace adit
