// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/motion/standstill.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "procs/scan_matching/scan_matching.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

using Status = ScanMatch::Status;

constexpr std::int64_t kStart = 1'000'000'000;
constexpr std::int64_t kPeriod = 26'666;  // of each LMS-200; the lasers alternate

/// A robot with a laser at each end, wheel odometry that may be wrong, and a true pose.
class TwoLasers {
 public:
  explicit TwoLasers(const test::WallWorld& world, const Pose2& start = {})
      : front_(world, 1), rear_(world, 2), T_world_body_(start), T_world_start_(start) {}

  /// One scan of each laser, after a step of body and wheels.
  void step(const Pose2& motion, const Pose2& wheels) {
    T_world_body_ = T_world_body_ * motion;
    T_wheel_body_ = T_wheel_body_ * wheels;
    utime_ += kPeriod;
    if (has_wheels_) matching_.add(WheelOdometry{utime_, T_wheel_body_});
    take(LaserId::kFront, front_.measure(T_world_body_, utime_));
    const Pose2 T_world_rear = T_world_body_ * Pose2{kRearOffM, 0.0, std::numbers::pi};
    take(LaserId::kRear, rear_.measure(T_world_rear, utime_));
  }

  [[nodiscard]] Pose2 error() const {
    return between(between(T_world_start_, T_world_body_), T_odom_body_);
  }
  [[nodiscard]] double moved_m() const { return moved_m_; }  ///< sum of all steps of odom
  [[nodiscard]] int lost() const { return lost_; }
  void forget_counts() { moved_m_ = 0.0, lost_ = 0; }
  void leave_out_wheels() { has_wheels_ = false; }

 private:
  static constexpr double kRearOffM = 0.02;  // typical mount error

  void take(LaserId laser, const LaserScan& scan) {
    const ScanMatch match = matching_.add_scan(laser, scan);
    moved_m_ += match.T_reference_body.translation().norm();
    lost_ += match.status == Status::kLost ? 1 : 0;
    T_odom_body_ = match.T_odom_body;
  }

  test::LevelLaser front_;
  test::LevelLaser rear_;
  ScanMatching matching_{ScanMatchingParams{}};
  std::int64_t utime_ = kStart;
  Pose2 T_world_body_;
  Pose2 T_world_start_;
  Pose2 T_wheel_body_;
  Pose2 T_odom_body_;
  double moved_m_ = 0.0;
  int lost_ = 0;
  bool has_wheels_ = true;
};

TEST(Standstill, HoldsThePoseWhileTheWheelsStand) {
  for (const bool mine : {false, true}) {
    TwoLasers robot(mine ? test::sample_mine(3) : test::straight_tunnel(400.0, 3.0),
                    {12.0, 0.1, 0.05});
    for (int i = 0; i < 40; ++i) robot.step({0.01, 0.0, 0.0}, {0.01, 0.0, 0.0});
    for (int i = 0; i < 30; ++i) robot.step({}, {});  // more than the half second of stationary_s
    robot.forget_counts();
    for (int i = 0; i < 500; ++i) robot.step({}, {});
    EXPECT_LT(robot.moved_m(), 1e-9);
    EXPECT_LT(robot.error().translation().norm(), 0.03);  // the offset of the rear laser
  }
}

TEST(Standstill, IsRefutedByScansWithBlockedWheels) {
  TwoLasers robot(test::crooked_room(), {-3.0, 0.0, 0.0});
  for (int i = 0; i < 30; ++i) robot.step({}, {});
  for (int i = 0; i < 100; ++i) robot.step({0.005, 0.0, 0.0}, {});  // it slides half a metre
  EXPECT_LT(robot.error().translation().norm(), 0.03);
}

TEST(Standstill, IsNotRefutedByLasersThatDisagree) {
  Standstill standstill{StandstillParams{}};
  MotionEstimate expected;
  expected.stationary = true;
  const auto pose_of = [&](LaserId laser, const Pose2& matched) {
    ScanMatch match;
    match.status = Status::kMatched;
    match.T_odom_body = matched;
    standstill.apply(laser, expected, match);
    return match.T_odom_body;
  };
  const Pose2 rear{0.065, 0.025, 0.0};  // it took rising ground for a wall
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(pose_of(LaserId::kFront, {}), Pose2{});
    EXPECT_EQ(pose_of(LaserId::kRear, rear), Pose2{});
  }
  // The front laser tilts for a 3D scan: only the other one is level.
  for (int i = 0; i < 50; ++i) EXPECT_EQ(pose_of(LaserId::kRear, rear), Pose2{});
  // Then the body slides.
  Pose2 slid;
  for (int i = 0; i < 10; ++i) slid = pose_of(LaserId::kRear, rear * Pose2{0.06, 0.0, 0.0});
  EXPECT_EQ(slid, rear * Pose2(0.06, 0.0, 0.0));
}

TEST(Standstill, EndsWhenTheWheelsMove) {
  TwoLasers robot(test::crooked_room(), {-3.0, 0.0, 0.0});
  for (int i = 0; i < 30; ++i) robot.step({}, {});
  for (int i = 0; i < 4; ++i) robot.step({0.01, 0.0, 0.0}, {0.01, 0.0, 0.0});
  EXPECT_LT(robot.error().translation().norm(), 0.03);  // 0.04 if the pose were still held
}

TEST(ScanMatching, KeepsTheReferenceOfARobotThatStandsForLong) {
  // Without wheel odometry, the disagreement of the lasers adds up to metres.
  TwoLasers robot(test::sample_mine(3), {12.0, 0.1, 0.05});
  robot.leave_out_wheels();
  for (int i = 0; i < 4000; ++i) robot.step({}, {});
  EXPECT_GT(robot.moved_m(), LocalReferenceParams{}.memory_m);
  for (int i = 0; i < 50; ++i) robot.step({0.01, 0.0, 0.0}, {});
  EXPECT_EQ(robot.lost(), 0);
}

TEST(ScanMatching, ResetsALaserThatMatchesNothingWhileTheOtherMatches) {
  ScanMatching matching{ScanMatchingParams{}};
  const test::WallWorld room = test::crooked_room();
  test::LevelLaser front(room, 1);
  test::LevelLaser rear(room, 2);
  test::LevelLaser rear_elsewhere(test::sample_mine(3), 2);
  int lost = 0;
  ScanMatch ahead;
  ScanMatch behind;
  for (int i = 0; i < 12; ++i) {
    const std::int64_t utime = kStart + i * kPeriod;
    ahead = matching.add_scan(LaserId::kFront, front.measure({-2.0, 0.0, 0.0}, utime));
    const Pose2 T_world_rear{i < 3 ? -2.0 : 40.0, 0.0, std::numbers::pi};
    behind = matching.add_scan(LaserId::kRear,
                               (i < 3 ? rear : rear_elsewhere).measure(T_world_rear, utime));
    lost += behind.status == Status::kLost ? 1 : 0;
  }
  EXPECT_GE(lost, 1);
  EXPECT_LE(lost, 4);
  EXPECT_EQ(behind.status, Status::kMatched);
  EXPECT_EQ(ahead.status, Status::kMatched);
  EXPECT_LT(ahead.T_odom_body.translation().norm(), 0.02);
}

}  // namespace
}  // namespace adit
