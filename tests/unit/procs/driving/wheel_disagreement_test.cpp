// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/wheel_disagreement.hpp"

#include <gtest/gtest.h>

#include "common/geometry/arc.hpp"

namespace adit {
namespace {

constexpr double kSpeedM_S = 0.4;
constexpr std::int64_t kTenthUs = 100'000;

class WheelsAndScans : public testing::Test {
 protected:
  /// The wheels turn all the time; the poses go on by a share of that.
  void drive(double seconds, double speed_m_s, double share, double curvature_1_m = 0.0) {
    for (int i = 0; i < std::lround(10.0 * seconds); ++i) {
      utime_ += kTenthUs;
      const double way_m = share * 0.1 * speed_m_s;
      T_odom_body_ = T_odom_body_ * along_arc(way_m, way_m * curvature_1_m);
      VehicleState state;
      state.utime = utime_;
      state.speed_m_s = speed_m_s;
      wheels_.add_state(state);
      wheels_.add_pose(utime_, T_odom_body_);
    }
  }

  std::int64_t utime_ = 1'600'000'000'000'000;
  Pose2 T_odom_body_{3.0, -2.0, 1.0};
  WheelDisagreement wheels_;
};

constexpr double kTickM = 0.1 * kSpeedM_S;  // the first says nothing yet

TEST_F(WheelsAndScans, AgreeWhereBothGoOn) {
  drive(10.0, kSpeedM_S, 1.0);
  EXPECT_NEAR(wheels_.apart_m(), 0.0, kTickM);
  drive(10.0, kSpeedM_S, 1.0, 0.5);  // round a bend
  EXPECT_NEAR(wheels_.apart_m(), 0.0, kTickM);
  EXPECT_NEAR(wheels_.driven_m(), 8.0, kTickM);
}

TEST_F(WheelsAndScans, AreApartWhereThePosesStand) {
  drive(1.0, kSpeedM_S, 1.0);
  drive(2.0, kSpeedM_S, 0.0);
  EXPECT_NEAR(wheels_.apart_m(), 2.0 * kSpeedM_S, kTickM);
}

TEST_F(WheelsAndScans, AreApartTheOtherWayInReverse) {
  drive(1.0, -kSpeedM_S, 1.0);
  drive(2.0, -kSpeedM_S, 0.0);
  EXPECT_NEAR(wheels_.apart_m(), -2.0 * kSpeedM_S, 2.0 * kTickM);
}

TEST_F(WheelsAndScans, BeginAnewWithAPathAndWhereTheWheelsFallSilent) {
  drive(2.0, kSpeedM_S, 0.0);
  utime_ += 1'000'000;
  drive(1.0, kSpeedM_S, 1.0);
  EXPECT_NEAR(wheels_.apart_m(), 0.0, kTickM);
  drive(2.0, kSpeedM_S, 0.0);
  wheels_.begin_anew();
  EXPECT_EQ(wheels_.apart_m(), 0.0);
  drive(1.0, kSpeedM_S, 1.0);
  for (int i = 0; i < 20; ++i) {  // the poses alone go on
    utime_ += kTenthUs;
    T_odom_body_.x += 0.1;
    wheels_.add_pose(utime_, T_odom_body_);
  }
  EXPECT_EQ(wheels_.apart_m(), 0.0);
}

}  // namespace
}  // namespace adit
