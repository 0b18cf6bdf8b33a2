// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/progress_monitor.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

TEST(HoldTimeout, IsExceededByALongHold) {
  HoldTimeout timeout(10.0);
  for (int s = 0; s <= 10; ++s) {
    timeout.update(kStart + s * kSecond, 2.0, true);
    EXPECT_FALSE(timeout.is_exceeded());
  }
  timeout.update(kStart + 11 * kSecond, 2.0, true);
  EXPECT_TRUE(timeout.is_exceeded());
}

TEST(HoldTimeout, IgnoresProgressOfACentimetre) {
  HoldTimeout timeout(10.0);
  for (int s = 0; s <= 10; ++s) timeout.update(kStart + s * kSecond, 2.0 + 0.004 * s, s % 2 == 0);
  timeout.update(kStart + 11 * kSecond, 2.04, false);
  EXPECT_FALSE(timeout.is_exceeded());
  timeout.update(kStart + 12 * kSecond, 2.04, true);
  EXPECT_TRUE(timeout.is_exceeded());
}

TEST(HoldTimeout, RestartsWithProgress) {
  HoldTimeout timeout(10.0);
  for (int s = 0; s <= 60; ++s) {
    timeout.update(kStart + s * kSecond, 0.01 * s, true);
    EXPECT_FALSE(timeout.is_exceeded());
  }
}

TEST(HoldTimeout, IsNotExceededByAVehicleThatStandsUnheld) {
  HoldTimeout timeout(10.0);
  for (int s = 0; s <= 60; ++s) timeout.update(kStart + s * kSecond, 2.0, false);
  timeout.update(kStart + 61 * kSecond, 2.0, true);
  EXPECT_FALSE(timeout.is_exceeded());
}

constexpr double kSpeedM_S = 0.4;
constexpr std::int64_t kTenthUs = 100'000;
constexpr double kTickM = 0.1 * kSpeedM_S;  // the first state yields no distance yet

class OdometryMismatchTest : public testing::Test {
 protected:
  /// The wheels turn at a speed; the poses move by a share of it.
  void drive(double seconds, double speed_m_s, double share, double curvature_1_m = 0.0) {
    for (int i = 0; i < std::lround(10.0 * seconds); ++i) {
      utime_ += kTenthUs;
      const double distance_m = share * 0.1 * speed_m_s;
      T_odom_body_ = T_odom_body_ * along_arc(distance_m, distance_m * curvature_1_m);
      VehicleState state;
      state.utime = utime_;
      state.speed_m_s = speed_m_s;
      mismatch_.add_state(state);
      mismatch_.add_pose(utime_, T_odom_body_);
    }
  }

  std::int64_t utime_ = kStart;
  Pose2 T_odom_body_{3.0, -2.0, 1.0};
  OdometryMismatch mismatch_;
};

TEST_F(OdometryMismatchTest, IsZeroWhereWheelsAndPosesAgree) {
  drive(10.0, kSpeedM_S, 1.0);
  EXPECT_NEAR(mismatch_.difference_m(), 0.0, kTickM);
  drive(10.0, kSpeedM_S, 1.0, 0.5);  // in a bend
  EXPECT_NEAR(mismatch_.difference_m(), 0.0, kTickM);
  EXPECT_NEAR(mismatch_.distance_travelled_m(), 8.0, kTickM);
}

TEST_F(OdometryMismatchTest, GrowsWhileThePosesStandStill) {
  drive(1.0, kSpeedM_S, 1.0);
  drive(2.0, kSpeedM_S, 0.0);
  EXPECT_NEAR(mismatch_.difference_m(), 2.0 * kSpeedM_S, kTickM);
}

TEST_F(OdometryMismatchTest, IsNegativeInReverse) {
  drive(1.0, -kSpeedM_S, 1.0);
  drive(2.0, -kSpeedM_S, 0.0);
  EXPECT_NEAR(mismatch_.difference_m(), -2.0 * kSpeedM_S, 2.0 * kTickM);
}

TEST_F(OdometryMismatchTest, ResetsWithAPathAndWithStaleWheels) {
  drive(2.0, kSpeedM_S, 0.0);
  utime_ += kSecond;
  drive(1.0, kSpeedM_S, 1.0);
  EXPECT_NEAR(mismatch_.difference_m(), 0.0, kTickM);
  drive(2.0, kSpeedM_S, 0.0);
  mismatch_.reset();
  EXPECT_EQ(mismatch_.difference_m(), 0.0);
  drive(1.0, kSpeedM_S, 1.0);
  for (int i = 0; i < 20; ++i) {  // only poses arrive
    utime_ += kTenthUs;
    T_odom_body_.x += 0.1;
    mismatch_.add_pose(utime_, T_odom_body_);
  }
  EXPECT_EQ(mismatch_.difference_m(), 0.0);
}

}  // namespace
}  // namespace adit
