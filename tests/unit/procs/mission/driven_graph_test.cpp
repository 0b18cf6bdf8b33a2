// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Ground that was driven is known in both directions.
#include "procs/mission/driven_graph.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "procs/mission/maneuver.hpp"
#include "procs/mission/traversed_path.hpp"

namespace adit {
namespace {

constexpr double kStepM = 0.25;

/// A robot that drives along the x axis and into a side tunnel along y at x = 10 m.
class DrivenTunnels : public testing::Test {
 protected:
  void drive(const Pose2& from, const Pose2& to, double z_to_m = 0.0) {
    const Eigen::Vector2d leg = to.translation() - from.translation();
    const int steps = static_cast<int>(std::lround(leg.norm() / kStepM));
    const double z_from_m = z_m_;
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const Eigen::Vector2d p = from.translation() + share * leg;
      z_m_ = std::lerp(z_from_m, z_to_m, share);
      path_.add(++utime_, {p.x(), p.y(), to.theta}, z_m_);
    }
  }
  /// A turn on the spot.
  void turn(const Pose2& from, double to_rad) {
    for (int i = 1; i <= 20; ++i)
      path_.add(++utime_, {from.x, from.y, std::lerp(from.theta, to_rad, i / 20.0)}, z_m_);
  }
  /// To the end of the tunnel, 20 m, and back; into the side tunnel, 8 m, and back.
  void drive_both() {
    drive({0.0, 0.0, 0.0}, {20.0, 0.0, 0.0});
    drive({20.0, 0.0, 0.0}, {10.0, 0.0, 0.0});  // backwards
    turn({10.0, 0.0, 0.0}, std::numbers::pi / 2.0);
    drive({10.0, 0.0, std::numbers::pi / 2.0}, {10.0, 8.0, std::numbers::pi / 2.0});
    drive({10.0, 8.0, std::numbers::pi / 2.0}, {10.0, 0.0, std::numbers::pi / 2.0});
  }
  static std::vector<Eigen::Vector2d> line(const std::vector<Eigen::Vector2d>& corners) {
    std::vector<Eigen::Vector2d> points{corners.front()};
    for (std::size_t i = 1; i < corners.size(); ++i) {
      for (int k = 1; k <= 20; ++k)
        points.emplace_back(corners[i - 1] + k / 20.0 * (corners[i] - corners[i - 1]));
    }
    return points;
  }

  TraversedPath path_;
  std::int64_t utime_ = 0;
  double z_m_ = 0.0;
};

TEST_F(DrivenTunnels, LeadIntoATunnelThatTheRobotHasLeft) {
  drive_both();
  EXPECT_LT(path_.shared_length_m(line({{10.0, 0.0}, {20.0, 0.0}})), 1.01);  // not the path back
  const auto known = path_.known_part(line({{10.0, 0.0}, {20.0, 0.0}}), true);
  EXPECT_NEAR(known.along_m, 10.0, kStepM);
  ASSERT_GT(known.path_odom.size(), 30U);
  EXPECT_NEAR(known.path_odom.front().theta, std::numbers::pi / 2.0, 1e-9);
  EXPECT_NEAR(known.path_odom.back().x, 20.0, kStepM);
  EXPECT_NEAR(known.path_odom.back().theta, 0.0, 1e-9);
  for (std::size_t i = 1; i < known.path_odom.size(); ++i) {
    const Pose2 step = between(known.path_odom[i - 1], known.path_odom[i]);
    EXPECT_LT(step.translation().norm(), 0.36);
    EXPECT_LT(std::abs(step.theta), 0.21);
  }
}

TEST_F(DrivenTunnels, LeadAroundACornerToTheEndOfTheOtherTunnel) {
  drive_both();
  drive({10.0, 0.0, std::numbers::pi / 2.0}, {10.0, 8.0, std::numbers::pi / 2.0});
  const auto known = path_.known_part(line({{10.0, 8.0}, {10.0, 0.0}, {20.0, 0.0}}), true);
  EXPECT_NEAR(known.along_m, 18.0, kStepM);
}

TEST_F(DrivenTunnels, EndWhereNothingWasDriven) {
  drive_both();
  EXPECT_NEAR(path_.known_part(line({{10.0, 0.0}, {30.0, 0.0}}), true).along_m, 10.0, kStepM);
  EXPECT_LT(path_.known_part(line({{10.0, 0.0}, {10.0, -8.0}}), true).along_m, 1.01);
  EXPECT_LT(path_.known_part(line({{10.0, 0.0}, {17.0, 7.0}}), true).along_m, 1.8);
  EXPECT_EQ(path_.known_part({}, true).along_m, 0.0);
  EXPECT_EQ(TraversedPath{}.known_part(line({{10.0, 0.0}, {17.0, 7.0}}), true).along_m, 0.0);
}

TEST_F(DrivenTunnels, AreNotDrivenBackwardsByARobotThatDoesNotSeeBehind) {
  drive({0.0, 0.0, 0.0}, {20.0, 0.0, 0.0});
  const auto back = line({{20.0, 0.0}, {5.0, 0.0}});
  EXPECT_NEAR(path_.known_part(back, true).along_m, 15.0, kStepM);
  EXPECT_LT(path_.known_part(back, false).along_m, 1.01);
  drive({20.0, 0.0, 0.0}, {10.0, 0.0, 0.0});
  EXPECT_NEAR(path_.known_part(line({{10.0, 0.0}, {20.0, 0.0}}), false).along_m, 10.0, kStepM);
}

/// The newest stored pose is behind a robot that drives forwards, so a path does not begin there.
TEST_F(DrivenTunnels, BeginAtTheBody) {
  drive({0.0, 0.0, 0.0}, {20.0, 0.0, 0.0});
  drive({20.0, 0.0, 0.0}, {10.0, 0.0, 0.0});
  path_.add(++utime_, {10.1, 0.0, 0.0});  // too near to be stored
  const auto known = path_.known_part(line({{10.1, 0.0}, {20.0, 0.0}}), true);
  ASSERT_GT(known.path_odom.size(), 2U);
  EXPECT_EQ(known.path_odom[0].x, 10.1);
  EXPECT_GT(known.path_odom[1].x, 10.1);
}

/// A ramp that crosses itself: 10 m up along x, round a square, and over its beginning.
TEST_F(DrivenTunnels, StayOnTheLevelOfTheRoute) {
  drive({0.0, 0.0, 0.0}, {20.0, 0.0, 0.0});
  turn({20.0, 0.0, 0.0}, std::numbers::pi / 2.0);
  drive({20.0, 0.0, std::numbers::pi / 2.0}, {20.0, 10.0, std::numbers::pi / 2.0}, 4.0);
  turn({20.0, 10.0, std::numbers::pi / 2.0}, std::numbers::pi);
  drive({20.0, 10.0, std::numbers::pi}, {10.0, 10.0, std::numbers::pi}, 4.0);
  turn({10.0, 10.0, std::numbers::pi}, 1.5 * std::numbers::pi);
  drive({10.0, 10.0, 1.5 * std::numbers::pi}, {10.0, -5.0, 1.5 * std::numbers::pi}, 6.0);
  // Where it crosses the first tunnel, 6 m below, the route along that is not driven ground.
  const auto crossing = line({{10.0, -5.0}, {10.0, 0.0}, {0.0, 0.0}});
  EXPECT_LT(path_.known_part(crossing, true).along_m, 6.1);
  const auto down = line({{10.0, -5.0}, {10.0, 10.0}, {20.0, 10.0}, {20.0, 0.0}, {0.0, 0.0}});
  EXPECT_NEAR(path_.known_part(down, true).along_m, 55.0, 2.0 * kStepM);
}

/// A loop closure moved what was driven long ago by a metre: nothing leads across the step.
TEST_F(DrivenTunnels, EndAtAStepOfTheMap) {
  drive({0.0, 0.0, 0.0}, {30.0, 0.0, 0.0});
  path_.correct({0.0, 0.8, 0.0});
  const auto known = path_.known_part(line({{30.0, 0.0}, {0.0, 0.0}}), true);
  EXPECT_NEAR(known.along_m, 10.0, 2.0 * kStepM);
}

TEST_F(DrivenTunnels, LeadOnIntoAnEarlierOdomFrame) {
  drive_both();
  path_.reset(Pose2{5.0, 0.0, 0.0});
  path_.add(++utime_, {0.0, 0.0, std::numbers::pi / 2.0});
  EXPECT_EQ(path_.known_part(line({{0.0, 0.0}, {10.0, 0.0}}), true).along_m, 0.0);
  path_.anchor(Pose2{15.0, 0.0, 0.0});  // where the robot stood
  EXPECT_NEAR(path_.known_part(line({{0.0, 0.0}, {10.0, 0.0}}), true).along_m, 10.0, kStepM);
  EXPECT_NEAR(path_.known_part(line({{0.0, 0.0}, {-10.0, 0.0}}), true).along_m, 10.0, kStepM);
}

/// A robot 3 m before the tunnel that it drove, to which it came by another path.
class GroundToJoin : public DrivenTunnels {
 protected:
  void SetUp() override {
    drive({0.0, 0.0, 0.0}, {20.0, 0.0, 0.0});
    drive({20.0, 0.0, 0.0}, {20.0, 8.0, 0.0});
    drive({20.0, 8.0, 0.0}, {-3.0, 8.0, 0.0});
  }
  void stand(double heading_rad) {
    drive({-3.0, 8.0, heading_rad}, {-3.0, 0.5, heading_rad});
    EXPECT_LT(path_.known_part(route_, true).along_m, 1.01);
  }
  std::vector<Eigen::Vector2d> route_ = line({{-3.0, 0.5}, {0.0, 0.0}, {20.0, 0.0}});
};

TEST_F(GroundToJoin, LeadsOnFromItsBeginning) {
  stand(0.0);
  const auto known = path_.joined_part(route_, 6.0, true, false);
  EXPECT_NEAR(known.along_m, std::hypot(3.0, 0.5) + 20.0, kStepM);
  ASSERT_FALSE(known.path_odom.empty());
  EXPECT_LT(known.path_odom.front().x, 0.5);
  EXPECT_NEAR(known.path_odom.back().x, 20.0, kStepM);
  EXPECT_TRUE(path_.joined_part(route_, 1.5, true, false).path_odom.empty());  // too far away
}

TEST_F(GroundToJoin, IsDrivenWithTheOtherEndAheadByASymmetricVehicle) {
  stand(std::numbers::pi);
  const auto known = path_.joined_part(route_, 6.0, true, true);
  ASSERT_GT(known.path_odom.size(), 50U);
  for (const Pose2& T_odom : known.path_odom)
    EXPECT_NEAR(std::abs(angle_diff(T_odom.theta, std::numbers::pi)), 0.0, 1e-9);
  EXPECT_TRUE(path_.joined_part(route_, 6.0, true, false).path_odom.empty());  // Ackermann steering
}

TEST_F(GroundToJoin, IsDrivenForwardsByARobotThatDoesNotSeeBehind) {
  stand(std::numbers::pi);
  const auto known = path_.joined_part(route_, 6.0, false, true);
  ASSERT_GT(known.path_odom.size(), 50U);
  EXPECT_NEAR(known.path_odom.front().theta, 0.0, 1e-9);
}

TEST_F(GroundToJoin, IsWorthAPlanOnlyFartherThanAScanLeads) {
  stand(0.0);
  const Retracing retracing;
  const auto far = retracing.join(path_, route_, true, true);
  ASSERT_TRUE(far);
  EXPECT_EQ(far->kind, PlanGoal::Kind::kRejoin);
  EXPECT_TRUE(far->is_short_cut);
  EXPECT_GT(length_of_path_m(far->path_odom), 15.0);
  EXPECT_FALSE(retracing.join(path_, line({{-3.0, 0.5}, {0.0, 0.0}, {6.0, 0.0}}), true, true));
}

TEST_F(GroundToJoin, IsNotThatOfAnotherLevel) {
  stand(0.0);
  path_.add(++utime_, {-3.0, 0.0, 0.0}, 4.0);
  EXPECT_TRUE(path_.joined_part(route_, 6.0, true, true).path_odom.empty());
}

/// Beside a detour of 1.2 m around something that has been taken away since.
TEST_F(DrivenTunnels, TakeTheShorterOfTwoPaths) {
  drive({0.0, 0.0, 0.0}, {4.0, 0.0, 0.0});
  drive({4.0, 0.0, 0.0}, {5.0, 0.6, 0.0});
  drive({5.0, 0.6, 0.0}, {6.0, 0.0, 0.0});
  drive({6.0, 0.0, 0.0}, {10.0, 0.0, 0.0});
  drive({10.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  const auto known = path_.known_part(line({{0.0, 0.0}, {10.0, 0.0}}), true);
  EXPECT_NEAR(known.along_m, 10.0, kStepM);
  EXPECT_NEAR(length_of_path_m(known.path_odom), 10.0, kStepM);
}

}  // namespace
}  // namespace adit
