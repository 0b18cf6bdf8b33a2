// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/ground/body_attitude.hpp"

#include <algorithm>
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

/// Whether a beam of a laser fixed to the body that ends above `p_level` is near the laser's height
/// above the ground there.
bool is_level_at(const BodyAttitude& body, const Eigen::Vector2d& p_level) {
  constexpr double kLaserM = 0.6;
  SurfacePoint point;
  point.p = p_level;
  point.z_m = kLaserM + ground_slope(body.attitude().value_or(Attitude{})).dot(p_level);
  return body.is_level_at(point, kLaserM);
}

TEST(BodyAttitude, FindsWhereADippedBodyObservesTheGround) {
  BodyAttitude body_attitude{BodyAttitudeParams{}};
  TurningBody body;
  body.turn(kStill, 100, body_attitude);
  EXPECT_TRUE(is_level_at(body_attitude, {9.0, 0.0}));
  body.turn(kDip, 100, body_attitude);
  const double displacement_max_m = BodyAttitudeParams{}.rise_max_m / std::tan(kDipRad);
  for (const double side : {-1.0, 1.0}) {  // the roof behind
    EXPECT_TRUE(is_level_at(body_attitude, {side * (displacement_max_m - 0.1), 0.0}));
    EXPECT_FALSE(is_level_at(body_attitude, {side * (displacement_max_m + 0.1), 0.0}));
    EXPECT_TRUE(is_level_at(body_attitude, {0.0, side * 9.0}));
  }
  body.turn(kStill, 1000, body_attitude);  // a standing body does not update the ground
  EXPECT_FALSE(is_level_at(body_attitude, {9.0, 0.0}));
}

TEST(BodyAttitude, AdoptsALongSlopeAsTheGround) {
  BodyAttitude body_attitude{BodyAttitudeParams{}};
  TurningBody body(0.1);
  body.turn(kStill, 100, body_attitude);
  EXPECT_TRUE(is_level_at(body_attitude, {20.0, 0.0}));
  body.turn({0.0, 0.0, std::numbers::pi / 2.0}, 100, body_attitude);  // and after a turn across it
  EXPECT_TRUE(is_level_at(body_attitude, {20.0, 0.0}));
  EXPECT_TRUE(is_level_at(body_attitude, {0.0, 20.0}));
  body.turn(kDip, 100, body_attitude);
  EXPECT_FALSE(is_level_at(body_attitude, {9.0, 0.0}));
  for (int metre = 0; metre < 30; ++metre)
    body_attitude.drive(1.0);  // three times the length of the mean
  EXPECT_TRUE(is_level_at(body_attitude, {9.0, 0.0}));
}

/// Whether points 9 m ahead, as high as on the ramp, are accepted after this distance on a ramp
/// that rises by 0.1 rad.
bool is_ramp_level_after(double distance_m, const BodyAttitudeParams& params = {}) {
  BodyAttitude body_attitude{params};
  TurningBody body;
  body.turn(kStill, 100, body_attitude);
  body.turn({0.0, -0.1, 0.0}, 100, body_attitude);
  for (double driven_m = 0.0; driven_m < distance_m; driven_m += 0.1) body_attitude.drive(0.1);
  return is_level_at(body_attitude, {9.0, 0.0});
}

TEST(BodyAttitude, AdoptsARampWithinAFewMetres) {
  EXPECT_FALSE(is_ramp_level_after(0.0));
  EXPECT_FALSE(is_ramp_level_after(0.5));  // exp(−0.5 / 2) · 0.1 · 9 m = 0.7 m
  EXPECT_TRUE(is_ramp_level_after(5.0));   // exp(−5 / 2) · 0.1 · 9 m = 0.07 m
  BodyAttitudeParams slow;
  slow.ramp_m = slow.ground_m;
  EXPECT_FALSE(is_ramp_level_after(5.0, slow));  // exp(−5 / 10) · 0.1 · 9 m = 0.55 m
}

TEST(BodyAttitude, AcceptsTheLongSlopeWhileItAdoptsARamp) {
  BodyAttitude body_attitude{BodyAttitudeParams{}};
  TurningBody body;
  body.turn(kStill, 100, body_attitude);
  body.turn({0.0, -0.1, 0.0}, 100, body_attitude);
  for (int i = 0; i < 40; ++i) body_attitude.drive(0.1);
  SurfacePoint level;
  level.p = {9.0, 0.0};
  level.z_m = 0.6;
  EXPECT_TRUE(body_attitude.is_level_at(level, 0.6));  // (1 − exp(−4 / 10)) · 0.9 m = 0.30 m
}

TEST(BodyAttitude, RejectsTheFloorSeenByABodyTiltedForAMoment) {
  BodyAttitude body_attitude{BodyAttitudeParams{}};
  TurningBody body;
  body.turn(kStill, 100, body_attitude);
  body.turn(kDip, 100, body_attitude);
  for (int i = 0; i < 3; ++i) body_attitude.drive(0.1);  // through a hole of 0.3 m
  // A level beam of a laser at 0.6 m meets the floor at 0.6 / 0.07 = 8.6 m.
  EXPECT_FALSE(is_level_at(body_attitude, {8.6, 0.0}));
  EXPECT_TRUE(is_level_at(body_attitude, {4.0, 0.0}));  // 0.28 m
}

TEST(BodyAttitude, MeasuresRollAndPitch) {
  BodyAttitude body_attitude{BodyAttitudeParams{}};
  EXPECT_FALSE(body_attitude.attitude().has_value());
  TurningBody body(0.1);
  body.turn(kStill, 100, body_attitude);
  ASSERT_TRUE(body_attitude.attitude().has_value());
  EXPECT_NEAR(body_attitude.attitude()->pitch_rad, 0.1, 1e-3);
  EXPECT_NEAR(body_attitude.attitude()->roll_rad, 0.0, 1e-3);
  body.turn({0.2, 0.0, 0.0}, 100, body_attitude);
  EXPECT_NEAR(body_attitude.attitude()->roll_rad, 0.2, 5e-3);
}

TEST(BodyAttitude, IsNotTiltedByTheAccelerationOfTheBody) {
  // 0.3 m/s² for two seconds, 0.6 m/s for one, and the same back to rest. Without the poses the
  // specific force would tilt the body by 0.3 / 9.81 = 0.03 rad.
  BodyAttitude body_attitude{BodyAttitudeParams{}};
  double x_m = 0.0;
  double speed_m_s = 0.0;
  double worst_rad = 0.0;
  for (int i = 1; i <= 700; ++i) {
    const double acceleration = i <= 100   ? 0.0
                                : i <= 300 ? 0.3
                                : i <= 400 ? 0.0
                                : i <= 600 ? -0.3
                                           : 0.0;
    speed_m_s += 0.01 * acceleration;
    x_m += 0.01 * speed_m_s;
    const std::int64_t utime = i * kPeriod;
    body_attitude.add(ImuReading{utime, kStill, {acceleration, 0.0, kGravity}});
    if (i % 2 == 0) body_attitude.add(utime, Pose2{x_m, 0.0, 0.0});
    worst_rad = std::max(worst_rad, std::abs(body_attitude.attitude()->pitch_rad));
  }
  EXPECT_LT(worst_rad, 0.005);
}

/// Largest pitch of a body at rest whose matched pose runs away for a second: the feedback of a
/// wrong match on the attitude that the next match uses.
double pitch_by_a_wrong_match(double acceleration_m_s2, bool with_wheels,
                              const BodyAttitudeParams& params = {}) {
  BodyAttitude body_attitude{params};
  double worst_rad = 0.0;
  for (int i = 1; i <= 300; ++i) {
    const std::int64_t utime = i * kPeriod;
    body_attitude.add(ImuReading{utime, kStill, kUp});
    const double wrong_s = std::max(0.0, 0.01 * (i - 200));
    body_attitude.add(utime, Pose2{0.5 * acceleration_m_s2 * wrong_s * wrong_s, 0.0, 0.0});
    if (with_wheels) body_attitude.add(WheelOdometry{utime, {}});
    worst_rad = std::max(worst_rad, std::abs(body_attitude.attitude()->pitch_rad));
  }
  return worst_rad;
}

TEST(BodyAttitude, IsNotTiltedByAMatchThatTheWheelsContradict) {
  EXPECT_LT(pitch_by_a_wrong_match(0.8, true), 1e-3);
  EXPECT_GT(pitch_by_a_wrong_match(0.8, false), 0.01);  // 0.8 / 9.81 for 0.7 of three seconds
}

TEST(BodyAttitude, IgnoresAnAccelerationThatNoVehicleHas) {
  BodyAttitudeParams credulous;
  credulous.acceleration_max_m_s2 = 100.0;
  EXPECT_GT(pitch_by_a_wrong_match(2.5, false, credulous), 0.025);
  EXPECT_LT(pitch_by_a_wrong_match(2.5, false), 0.01);
}

TEST(BodyAttitude, AcceptsAllPointsWithoutAnAccelerometer) {
  BodyAttitude body_attitude{BodyAttitudeParams{}};
  for (int i = 1; i < 200; ++i)
    body_attitude.add(ImuReading{i * kPeriod, kDip, Eigen::Vector3d::Zero()});
  EXPECT_TRUE(is_level_at(body_attitude, {50.0, 0.0}));
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
  blind.attitude.rise_max_m = 100.0;
  EXPECT_NEAR(matched_m(blind), 3.54, 0.05);  // what may be ground may move
  blind.search.point_to_line.laser_m = 1e6;   // it may not
  EXPECT_LT(matched_m(blind), 3.0);           // it is held back
}

}  // namespace
}  // namespace adit
