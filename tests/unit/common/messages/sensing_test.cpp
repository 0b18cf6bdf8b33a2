// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/sensing.hpp"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/fields/quantities.hpp"
#include "common/messages/mapping/odometry.hpp"

namespace adit {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr float kFloatNaN = std::numeric_limits<float>::quiet_NaN();
constexpr std::int64_t kUtime = 1'600'000'000'000'000;

/// Encodes and decodes a value.
template <class Value>
auto round_trip(const Value& value) {
  const auto message = to_message(value);
  return from_message(*decode<std::remove_const_t<decltype(message)>>(encode(message)));
}

LaserScan scan() { return {kUtime, {1.0F, 2.0F, 3.0F}, -1.5, 0.5}; }

ScanMatch report() {
  ScanMatch report;
  report.utime = kUtime;
  report.reference_utime = kUtime - 13'000;
  report.channel = "LASER_FRONT";
  report.status = ScanMatch::Status::kMatched;
  report.T_odom_body = {1.0, 2.0, 0.5};
  report.T_reference_body = {0.1, 0.0, 0.01};
  report.covariance << 10.0, 2.0, 3.0, 2.0, 11.0, 5.0, 3.0, 5.0, 12.0;
  report.ground_beams = {3, 90};
  report.unconfirmed_beams = {0, 91, 360};
  report.inlier_share = 0.9;
  report.rms_residual_m = 0.01;
  report.degenerate = {{Eigen::Vector3d::UnitX(), DegenerateDirection::Fill::kOdometry}};
  report.iterations = 12;
  report.searched = true;
  report.points = 180;
  return report;
}

TEST(LaserScanMessage, SurvivesARoundTrip) { EXPECT_EQ(*round_trip(scan()), scan()); }

TEST(LaserScanMessage, PreservesNanReadings) {
  LaserScan strange = scan();
  strange.ranges_m[1] = kFloatNaN;
  EXPECT_TRUE(std::isnan(round_trip(strange)->ranges_m[1]));
}

TEST(LaserScanMessage, MayBeEmpty) {
  LaserScan empty = scan();
  empty.ranges_m.clear();
  EXPECT_EQ(*round_trip(empty), empty);
}

TEST(LaserScanMessage, IsRejectedWithInvalidBearings) {
  for (const double step : {0.0, -0.1, kNaN}) {
    LaserScan bad = scan();
    bad.angle_step_rad = step;
    EXPECT_EQ(round_trip(bad).rejection(), "bearings do not increase") << step;
  }
  LaserScan bad = scan();
  bad.angle_min_rad = kNaN;
  EXPECT_EQ(round_trip(bad).rejection(), "implausible first bearing");
  bad = scan();
  bad.angle_step_rad = 5.0;
  EXPECT_EQ(round_trip(bad).rejection(), "bearings span more than two turns");
}

TEST(LaserScanMessage, IsRejectedWithAnImplausibleTime) {
  for (const std::int64_t utime : {std::int64_t{-1}, std::numeric_limits<std::int64_t>::max(),
                                   std::numeric_limits<std::int64_t>::min()}) {
    LaserScan bad = scan();
    bad.utime = utime;
    EXPECT_EQ(round_trip(bad).rejection(), kImplausibleTime) << utime;
  }
}

TEST(PoseMessage, SurvivesARoundTrip) {
  for (const double theta : {0.0, 1.0, -3.0, std::numbers::pi}) {
    const StampedPose pose{kUtime, {1.0, -2.0, theta}, Eigen::Vector3d(0.5, 0.0, 0.1)};
    const auto back = round_trip(pose);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->utime, kUtime);
    EXPECT_EQ(back->T_odom_body.x, 1.0);
    EXPECT_EQ(back->T_odom_body.y, -2.0);
    EXPECT_NEAR(angle_diff(back->T_odom_body.theta, theta), 0.0, 1e-15);
    EXPECT_EQ(*back->v_body, *pose.v_body);
  }
}

TEST(PoseMessage, MayHaveNoVelocity) {
  const auto back = round_trip(StampedPose{kUtime, {}, {}});
  EXPECT_FALSE(back->v_body);
}

TEST(PoseMessage, IsRejectedWithoutAUnitQuaternion) {
  pose_t message = to_message(StampedPose{kUtime, {}, {}});
  message.orientation[0] = 0.0;
  EXPECT_EQ(from_message(message).rejection(), "orientation is not a unit quaternion");
  message.orientation[0] = kNaN;
  EXPECT_EQ(from_message(message).rejection(), "orientation is not a unit quaternion");
}

TEST(PoseMessage, IsRejectedWithoutAHeading) {
  pose_t message = to_message(StampedPose{kUtime, {}, {}});
  message.orientation[0] = std::sqrt(0.5);
  message.orientation[2] = std::sqrt(0.5);  // nose down
  EXPECT_EQ(from_message(message).rejection(), "orientation has no heading");
}

TEST(PoseMessage, IsRejectedWithAPositionThatIsNotFinite) {
  EXPECT_EQ(round_trip(StampedPose{kUtime, {kNaN, 0.0, 0.0}, {}}).rejection(),
            kImplausiblePosition);
}

TEST(WheelOdometryMessage, SurvivesARoundTrip) {
  const auto back = round_trip(WheelOdometry{kUtime, {1.0, 2.0, 30.0}});
  EXPECT_EQ(back->utime, kUtime);
  EXPECT_EQ(back->T_wheel_body, (Pose2{1.0, 2.0, 30.0}));
}

TEST(WheelOdometryMessage, IsRejectedWithAPoseThatIsNotFinite) {
  EXPECT_EQ(round_trip(WheelOdometry{kUtime, {0.0, kNaN, 0.0}}).rejection(), kImplausiblePosition);
}

TEST(ImuMessage, SurvivesARoundTrip) {
  const ImuReading reading{kUtime, {0.1, 0.2, 0.3}, {0.0, 0.0, 9.81}};
  const auto back = round_trip(reading);
  EXPECT_EQ(back->utime, kUtime);
  EXPECT_EQ(back->angular_velocity, reading.angular_velocity);
  EXPECT_EQ(back->linear_acceleration, reading.linear_acceleration);
}

TEST(ImuMessage, IsRejectedWithNumbersThatAreNotFinite) {
  EXPECT_FALSE(round_trip(ImuReading{kUtime, {kNaN, 0.0, 0.0}, {0.0, 0.0, 9.81}}));
  EXPECT_FALSE(round_trip(ImuReading{kUtime, {0.0, 0.0, 0.0}, {0.0, 0.0, kNaN}}));
}

TEST(TiltMessage, SurvivesARoundTrip) {
  const TiltReading reading{kUtime, 0.3, -0.1};
  EXPECT_EQ(*round_trip(reading), reading);
}

TEST(TiltMessage, IsRejectedWithNumbersThatAreNotFinite) {
  EXPECT_FALSE(round_trip(TiltReading{kUtime, kNaN, 0.0}));
  EXPECT_FALSE(round_trip(TiltReading{kUtime, 0.0, kNaN}));
}

TEST(ScanMatchMessage, SurvivesARoundTrip) { EXPECT_EQ(*round_trip(report()), report()); }

TEST(ScanMatchMessage, StoresItsCovarianceRowByRow) {
  const scan_match_t message = to_message(report());
  EXPECT_EQ(message.covariance[0][1], 2.0);
  EXPECT_EQ(message.covariance[2][1], 5.0);
}

TEST(ScanMatchMessage, IsRejectedWithUnknownConstants) {
  scan_match_t message = to_message(report());
  message.status = 99;
  EXPECT_EQ(from_message(message).rejection(), "unknown status");
  message = to_message(report());
  message.degenerate_fills[0] = -1;
  EXPECT_EQ(from_message(message).rejection(), "unknown fill");
}

TEST(ScanMatchMessage, IsRejectedWithNumbersThatAreNotFinite) {
  ScanMatch bad = report();
  bad.covariance(1, 2) = kNaN;
  EXPECT_EQ(round_trip(bad).rejection(), kInvalidCovariance);
}

MatchDoubt doubt() {
  const MatchDoubt::Alternative turned{{1.0, 2.0, -1.5}, 0.75};
  return {kUtime, kUtime - 1'000'000, MatchDoubt::Reason::kAmbiguous, {turned}};
}

TEST(MatchDoubtMessage, SurvivesARoundTrip) { EXPECT_EQ(*round_trip(doubt()), doubt()); }

TEST(MatchDoubtMessage, IsRejectedIfItEndsBeforeItBegins) {
  MatchDoubt bad = doubt();
  bad.from_utime = bad.utime + 1;
  EXPECT_EQ(round_trip(bad).rejection(), "ends before it begins");
}

TEST(MatchDoubtMessage, IsRejectedWithAnUnknownReason) {
  match_doubt_t message = to_message(doubt());
  message.reason = 5;
  EXPECT_EQ(from_message(message).rejection(), "unknown reason");
}

TEST(MatchDoubtMessage, IsRejectedWithNumbersThatAreNotFinite) {
  MatchDoubt bad = doubt();
  bad.alternatives[0].score = kNaN;
  EXPECT_EQ(round_trip(bad).rejection(), "implausible score");
}

TEST(HeartbeatMessage, SurvivesARoundTrip) {
  const Heartbeat heartbeat{kUtime, "mapping", {Health::Level::kDegraded, "no odometry"}, 3, 2, 1};
  EXPECT_EQ(*round_trip(heartbeat), heartbeat);
}

TEST(HeartbeatMessage, IsRejectedWithoutAStage) {
  EXPECT_EQ(round_trip(Heartbeat{kUtime, "", {}, 0, 0, 0}).rejection(), "no stage");
}

TEST(ConfigMessage, SurvivesARoundTrip) {
  const ConfigSnapshot copy{kUtime, "mapping", "0.1.0", "a: 1\nb: [2, 3]\n"};
  EXPECT_EQ(*round_trip(copy), copy);
}

TEST(StageStatsMessage, SurvivesARoundTrip) {
  const StageStats stats{kUtime, "mapping", 5.0, {{"POSE", 3, 2, 1, 0.5, 0.7}, {"IMU", 1}}};
  EXPECT_EQ(*round_trip(stats), stats);
}

TEST(StageStatsMessage, IsRejectedWithAnInvalidInterval) {
  EXPECT_FALSE(round_trip(StageStats{kUtime, "mapping", -1.0, {}}));
  EXPECT_FALSE(round_trip(StageStats{kUtime, "mapping", kNaN, {}}));
}

}  // namespace
}  // namespace adit
