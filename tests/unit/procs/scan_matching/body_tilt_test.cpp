// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/body_tilt.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "common/registration/surface_points.hpp"
#include "procs/scan_matching/scan_matching.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

constexpr double kGravity = 9.81;
constexpr std::int64_t kPeriod = 10'000;
const Eigen::Vector3d kUp(0.0, 0.0, kGravity);
const Eigen::Vector3d kStill(0.0, 0.0, 0.0);

/// A body that turns about its own axes, with an IMU.
class TurningBody {
 public:
  explicit TurningBody(double nose_down_rad = 0.0)
      : R_world_body_(Eigen::AngleAxisd(nose_down_rad, Eigen::Vector3d::UnitY())) {}

  /// `periods` of 0.01 s at this rate [rad/s].
  template <class Listener>
  void turn(const Eigen::Vector3d& rate, int periods, Listener& listener) {
    for (int i = 0; i < periods; ++i) {
      const double angle = 1e-6 * static_cast<double>(kPeriod) * rate.norm();
      if (angle > 0.0) R_world_body_ = R_world_body_ * Eigen::AngleAxisd(angle, rate.normalized());
      utime_ += kPeriod;
      listener.add(ImuReading{utime_, rate, R_world_body_.inverse() * kUp});
    }
  }
  [[nodiscard]] std::int64_t utime() const { return utime_; }

 private:
  Eigen::Quaterniond R_world_body_;
  std::int64_t utime_ = 0;
};

constexpr double kDipRad = 0.07;  // the front wheels 0.1 m deep, at a wheelbase of 1.5 m
const Eigen::Vector3d kDip(0.0, kDipRad, 0.0);  // in one second

TEST(BodyTilt, FindsWhereADippedBodyObservesTheGround) {
  BodyTilt tilt{BodyTiltParams{}};
  TurningBody body;
  body.turn(kStill, 100, tilt);
  EXPECT_TRUE(tilt.is_level_at({9.0, 0.0}));
  body.turn(kDip, 100, tilt);
  const double displacement_max_m = BodyTiltParams{}.rise_max_m / std::tan(kDipRad);
  for (const double side : {-1.0, 1.0}) {  // the roof behind
    EXPECT_TRUE(tilt.is_level_at({side * (displacement_max_m - 0.1), 0.0}));
    EXPECT_FALSE(tilt.is_level_at({side * (displacement_max_m + 0.1), 0.0}));
    EXPECT_TRUE(tilt.is_level_at({0.0, side * 9.0}));
  }
  body.turn(kStill, 1000, tilt);  // a standing body does not update the ground
  EXPECT_FALSE(tilt.is_level_at({9.0, 0.0}));
}

TEST(BodyTilt, AdoptsALongSlopeAsTheGround) {
  BodyTilt tilt{BodyTiltParams{}};
  TurningBody body(0.1);
  body.turn(kStill, 100, tilt);
  EXPECT_TRUE(tilt.is_level_at({20.0, 0.0}));
  body.turn({0.0, 0.0, std::numbers::pi / 2.0}, 100, tilt);  // and after a turn across it
  EXPECT_TRUE(tilt.is_level_at({20.0, 0.0}));
  EXPECT_TRUE(tilt.is_level_at({0.0, 20.0}));
  body.turn(kDip, 100, tilt);
  EXPECT_FALSE(tilt.is_level_at({9.0, 0.0}));
  for (int metre = 0; metre < 30; ++metre) tilt.drive(1.0);  // three times the length of the mean
  EXPECT_TRUE(tilt.is_level_at({9.0, 0.0}));
}

TEST(BodyTilt, AcceptsAllPointsWithoutAnAccelerometer) {
  BodyTilt tilt{BodyTiltParams{}};
  for (int i = 1; i < 200; ++i) tilt.add(ImuReading{i * kPeriod, kDip, Eigen::Vector3d::Zero()});
  EXPECT_TRUE(tilt.is_level_at({50.0, 0.0}));
}

/// A body that dips and drives 3.54 m by its wheels in a tunnel whose walls do not constrain the
/// motion along it: the distance by the matches. The ground ahead appears as a wall that moves with
/// the body.
double matched_m(const ScanMatchingParams& params) {
  constexpr double kGroundM = 9.0;  // 0.62 m / 0.07
  ScanMatching matching{params};
  TurningBody body;
  body.turn(kStill, 100, matching);
  body.turn(kDip, 100, matching);
  ScanMatch match;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.06 * i;
    const test::WallWorld world({{{-50.0, 1.5}, {50.0, 1.5}},
                                 {{-50.0, -1.5}, {50.0, -1.5}},
                                 {{x + kGroundM, -1.5}, {x + kGroundM, 1.5}}});
    test::LevelLaser laser(world, static_cast<std::uint64_t>(i) + 1);
    matching.add(WheelOdometry{body.utime(), {x, 0.0, 0.0}});
    const LaserScan scan = laser.measure({x, 0.0, 0.0}, body.utime());
    match = matching.add_scan(LaserId::kFront, scan);
    body.turn(kStill, 20, matching);
  }
  return match.T_odom_body.x;
}

TEST(ScanMatching, IsNotHeldBackByTheGroundObservedByATiltedBody) {
  EXPECT_NEAR(matched_m({}), 3.54, 0.05);  // remaining information counts against the wheels
  ScanMatchingParams blind;
  blind.body_tilt.rise_max_m = 100.0;
  EXPECT_LT(matched_m(blind), 3.0);  // without the tilt it is held back
}

}  // namespace
}  // namespace adit
