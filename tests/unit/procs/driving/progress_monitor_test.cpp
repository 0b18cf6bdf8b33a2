// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/progress_monitor.hpp"

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

TEST(HoldTimeout, IsReachedBySomeoneHeldForLong) {
  HoldTimeout limit(10.0);
  for (int s = 0; s <= 10; ++s) {
    limit.update(kStart + s * kSecond, 2.0, true);
    EXPECT_FALSE(limit.is_reached());
  }
  limit.update(kStart + 11 * kSecond, 2.0, true);
  EXPECT_TRUE(limit.is_reached());
}

TEST(HoldTimeout, CountsStepsOfACentimetreAsStanding) {
  HoldTimeout limit(10.0);
  for (int s = 0; s <= 10; ++s) limit.update(kStart + s * kSecond, 2.0 + 0.004 * s, s % 2 == 0);
  limit.update(kStart + 11 * kSecond, 2.04, false);
  EXPECT_FALSE(limit.is_reached());
  limit.update(kStart + 12 * kSecond, 2.04, true);
  EXPECT_TRUE(limit.is_reached());
}

TEST(HoldTimeout, BeginsResetAfterSomeWay) {
  HoldTimeout limit(10.0);
  for (int s = 0; s <= 60; ++s) {
    limit.update(kStart + s * kSecond, 0.01 * s, true);
    EXPECT_FALSE(limit.is_reached());
  }
}

TEST(HoldTimeout, IsNotReachedBySomeoneWhoStandsUnheld) {
  HoldTimeout limit(10.0);
  for (int s = 0; s <= 60; ++s) limit.update(kStart + s * kSecond, 2.0, false);
  limit.update(kStart + 61 * kSecond, 2.0, true);
  EXPECT_FALSE(limit.is_reached());
}

}  // namespace
namespace {

constexpr double kSpeedM_S = 0.4;
constexpr std::int64_t kTenthUs = 100'000;

class OdometryMismatchTest : public testing::Test {
 protected:
  /// The wheels turn all the time; the poses go on by a share of that.
  void drive(double seconds, double speed_m_s, double share, double curvature_1_m = 0.0) {
    for (int i = 0; i < std::lround(10.0 * seconds); ++i) {
      utime_ += kTenthUs;
      const double distance_m = share * 0.1 * speed_m_s;
      T_odom_body_ = T_odom_body_ * along_arc(distance_m, distance_m * curvature_1_m);
      VehicleState state;
      state.utime = utime_;
      state.speed_m_s = speed_m_s;
      odometry_mismatch_.add_state(state);
      odometry_mismatch_.add_pose(utime_, T_odom_body_);
    }
  }

  std::int64_t utime_ = 1'600'000'000'000'000;
  Pose2 T_odom_body_{3.0, -2.0, 1.0};
  OdometryMismatch odometry_mismatch_;
};

constexpr double kTickM = 0.1 * kSpeedM_S;  // the first says nothing yet

TEST_F(OdometryMismatchTest, AgreeWhereBothGoOn) {
  drive(10.0, kSpeedM_S, 1.0);
  EXPECT_NEAR(odometry_mismatch_.difference_m(), 0.0, kTickM);
  drive(10.0, kSpeedM_S, 1.0, 0.5);  // round a bend
  EXPECT_NEAR(odometry_mismatch_.difference_m(), 0.0, kTickM);
  EXPECT_NEAR(odometry_mismatch_.distance_travelled_m(), 8.0, kTickM);
}

TEST_F(OdometryMismatchTest, AreApartWhereThePosesStand) {
  drive(1.0, kSpeedM_S, 1.0);
  drive(2.0, kSpeedM_S, 0.0);
  EXPECT_NEAR(odometry_mismatch_.difference_m(), 2.0 * kSpeedM_S, kTickM);
}

TEST_F(OdometryMismatchTest, AreApartTheOtherWayInReverse) {
  drive(1.0, -kSpeedM_S, 1.0);
  drive(2.0, -kSpeedM_S, 0.0);
  EXPECT_NEAR(odometry_mismatch_.difference_m(), -2.0 * kSpeedM_S, 2.0 * kTickM);
}

TEST_F(OdometryMismatchTest, BeginResetWithAPathAndWhereTheWheelsFallStale) {
  drive(2.0, kSpeedM_S, 0.0);
  utime_ += 1'000'000;
  drive(1.0, kSpeedM_S, 1.0);
  EXPECT_NEAR(odometry_mismatch_.difference_m(), 0.0, kTickM);
  drive(2.0, kSpeedM_S, 0.0);
  odometry_mismatch_.begin_reset();
  EXPECT_EQ(odometry_mismatch_.difference_m(), 0.0);
  drive(1.0, kSpeedM_S, 1.0);
  for (int i = 0; i < 20; ++i) {  // the poses alone go on
    utime_ += kTenthUs;
    T_odom_body_.x += 0.1;
    odometry_mismatch_.add_pose(utime_, T_odom_body_);
  }
  EXPECT_EQ(odometry_mismatch_.difference_m(), 0.0);
}

}  // namespace
}  // namespace adit
