// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The next of the way that exploration gives to who plans.
#include <gtest/gtest.h>

#include "procs/exploration/exploration.hpp"
#include "tests/support/exploring_robot.hpp"
#include "tests/unit/procs/exploration/mines.hpp"

namespace adit {
namespace {

constexpr double kLengthM = 12.0;
constexpr double kSpacingM = 0.3;

class TheNextWay : public testing::Test {
 protected:
  TheNextWay() { take_map(); }

  void take_map() {
    exploration_.add(robot_.last_map());
    exploration_.update(robot_.graph());
  }
  std::vector<Eigen::Vector2d> way(bool homeward) {
    exploration_.decide({robot_.utime(), robot_.T_map_body(), 2000.0, 0.0, homeward});
    return exploration_.next_way(kLengthM, kSpacingM);
  }
  static double length_of(const std::vector<Eigen::Vector2d>& way) {
    double length_m = 0.0;
    for (std::size_t i = 1; i < way.size(); ++i) {
      const double step_m = (way[i] - way[i - 1]).norm();
      EXPECT_LE(step_m, kSpacingM + 1e-9);
      length_m += step_m;
    }
    return length_m;
  }

  test::LightMine mine_ = drift_mine(junction());
  test::ExploringRobot robot_{mine_};
  Exploration exploration_{ExplorationParams{}};
};

TEST_F(TheNextWay, BeginsAtTheRobotAndStaysWhereItCanDrive) {
  for (int i = 0; i < 4; ++i) {
    const auto way = this->way(false);
    ASSERT_GT(way.size(), 2U);
    EXPECT_EQ(way.front(), robot_.T_map_body().translation());
    EXPECT_LE(length_of(way), kLengthM + 1e-9);
    for (std::size_t k = 0; k < way.size() / 2; ++k) {  // what lies beyond a stub, nobody knows
      EXPECT_TRUE(mine_.reachable(mine_.T_world_start * way[k]));
    }
    robot_.go(way, 5.0);
    take_map();
  }
}

/// The side drift goes back beside the way in.
TEST(TheNextWayToASideDriftThatGoesBack, DoesNotComeBackToTheRobot) {
  const test::LightMine mine = drift_mine({{0, 0, 30, 0}, {20, 0, 14, 14}});
  test::ExploringRobot robot(mine);
  Exploration exploration{ExplorationParams{}};
  int back = 0;
  for (int i = 0; i < 12; ++i) {
    exploration.add(robot.last_map());
    exploration.update(robot.graph());
    const Eigen::Vector2d p_robot = robot.T_map_body().translation();
    const ExplorationDecision decision =
        exploration.decide({robot.utime(), robot.T_map_body(), 2000.0, 0.0, false});
    const auto way = exploration.next_way(kLengthM, kSpacingM);
    if (way.size() < 2 || decision.stub < 0) break;
    const Stub& stub = exploration.stubs()[static_cast<std::size_t>(decision.stub)];
    const Eigen::Vector2d to_stub = stub.p_map - p_robot;
    if (to_stub.norm() > 3.0 && decision.distance_m < kLengthM &&
        to_stub.dot(stub.direction_map) < 0.0) {
      ++back;
      EXPECT_NEAR((way.back() - stub.p_map).norm(), 0.0, 0.5);  // within the smoothing
    }
    robot.go(way, 2.0);
  }
  EXPECT_GT(back, 0);
}

TEST_F(TheNextWay, EndsAtHome) {
  robot_.go(way(false), 5.0);
  take_map();
  const auto home = way(true);
  ASSERT_GT(home.size(), 2U);
  EXPECT_NEAR(home.back().norm(), 0.0, 1e-9);
  EXPECT_NEAR(length_of(home), 5.0, 0.5);
}

TEST_F(TheNextWay, IsNoneAtHome) { EXPECT_TRUE(way(true).empty()); }

TEST_F(TheNextWay, IsNoneWithoutAMap) {
  EXPECT_TRUE(Exploration(ExplorationParams{}).next_way(kLengthM, kSpacingM).empty());
}

}  // namespace
}  // namespace adit
