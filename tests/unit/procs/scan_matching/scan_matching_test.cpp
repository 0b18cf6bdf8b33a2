// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/scan_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

using Status = ScanMatch::Status;

constexpr std::int64_t kStart = 1'000'000'000;
constexpr std::int64_t kPeriod = 200'000;

/// A body with a laser, moved through a world by known steps.
class SimulatedDrive {
 public:
  SimulatedDrive(const test::WallWorld& world, const Pose2& start, std::uint64_t seed = 1)
      : laser_(world, seed), T_world_body_(start) {
    matches_.push_back(matching_.add_scan(LaserId::kFront, measure_scan()));
  }

  ScanMatch step(const Pose2& motion, std::int64_t period_us = kPeriod) {
    T_world_body_ = T_world_body_ * motion;
    truth_ = truth_ * motion;
    utime_ += period_us;
    matches_.push_back(matching_.add_scan(LaserId::kFront, measure_scan()));
    return matches_.back();
  }

  LaserScan measure_scan() { return laser_.measure(T_world_body_, utime_); }
  ScanMatch first() const { return matches_.front(); }
  ScanMatching& matching() { return matching_; }
  std::int64_t utime() const { return utime_; }
  const Pose2& T_world_body() const { return T_world_body_; }
  /// True pose in odom, which starts at the first pose.
  const Pose2& truth() const { return truth_; }

 private:
  test::LevelLaser laser_;
  ScanMatching matching_{ScanMatchingParams{}};
  std::int64_t utime_ = kStart;
  Pose2 T_world_body_;
  Pose2 truth_;
  std::vector<ScanMatch> matches_;
};

void expect_near(const Pose2& actual, const Pose2& expected, double metres, double radians) {
  const Pose2 error = between(expected, actual);
  EXPECT_LT(error.translation().norm(), metres);
  EXPECT_LT(std::abs(error.theta), radians);
}

bool is_near(const Pose2& a, const Pose2& b) {
  const Pose2 apart = between(a, b);
  return apart.translation().norm() < 0.2 && std::abs(apart.theta) < 0.05;
}

/// Whether the pose, or one of the alternatives of the doubt, is the truth.
bool admits_truth(const ScanMatch& match, SimulatedDrive& drive) {
  if (is_near(match.T_odom_body, drive.truth())) return true;
  const auto& doubt = drive.matching().doubt();
  return doubt && std::ranges::any_of(doubt->alternatives, [&](const auto& alternative) {
           return is_near(alternative.T_odom_body, drive.truth());
         });
}

TEST(ScanMatching, FindsATurnBetweenTwoScansInACrookedRoom) {
  SimulatedDrive drive(test::crooked_room(), {-2.0, 0.0, 0.3});
  for (int i = 0; i < 32; ++i) drive.step({0.0, 0.0, 0.2});
  const ScanMatch match = drive.step({0.5, 0.0, 1.6}, 20 * kPeriod);
  expect_near(match.T_odom_body, drive.truth(), 0.02, 0.005);
  EXPECT_TRUE(admits_truth(match, drive));
}

TEST(ScanMatching, DoubtsATurnBetweenTwoScansInARectangularHall) {
  const test::WallWorld hall({{{-6.0, -3.0}, {6.0, -3.0}},
                              {{6.0, -3.0}, {6.0, 3.0}},
                              {{6.0, 3.0}, {-6.0, 3.0}},
                              {{-6.0, 3.0}, {-6.0, -3.0}}});
  for (const double turn : {1.6, 3.1}) {
    SimulatedDrive drive(hall, {0.5, 0.3, 0.0});
    for (int i = 0; i < 32; ++i) drive.step({0.0, 0.0, 0.2});
    const ScanMatch match = drive.step({0.0, 0.0, turn}, 20 * kPeriod);
    ASSERT_TRUE(drive.matching().doubt()) << turn;
    EXPECT_EQ(drive.matching().doubt()->reason, MatchDoubt::Reason::kAmbiguous);
    EXPECT_TRUE(admits_truth(match, drive)) << turn;
  }
}

TEST(ScanMatching, IsSureOfScansInQuickSuccession) {
  SimulatedDrive drive(test::crooked_room(), {-2.0, 0.0, 0.3});
  for (int i = 0; i < 10; ++i) {
    drive.step({0.1, 0.0, 0.1});
    EXPECT_FALSE(drive.matching().doubt());
  }
}

/// Error of the heading of a body that begins to turn, by the scans of a laser that turns once in
/// 0.1 s, stated with this timing.
double heading_error_of_slow_laser(const ScanTiming& stated) {
  constexpr int kBeams = 360;
  constexpr double kRateRad_s = 0.5;
  const test::WallWorld room = test::crooked_room();
  ScanMatchingParams params;
  params.lasers.front.T_body_laser = {};
  params.lasers.front.timing = stated;
  ScanMatching matching(params);
  ScanMatch match;
  Pose2 T_odom_body;
  for (int i = 0; i < 40; ++i) {
    const double rate = kRateRad_s * std::clamp((i - 10) / 10.0, 0.0, 1.0);
    LaserScan scan{kStart + i * 100'000, {}, -std::numbers::pi, 2.0 * std::numbers::pi / kBeams};
    for (int beam = 0; beam < kBeams; ++beam) {
      const double turned = rate * 0.1 * beam / kBeams;
      const double bearing = scan.angle_min_rad + beam * scan.angle_step_rad;
      const Pose2 T_world_body = T_odom_body * Pose2{0.0, 0.0, turned};
      scan.ranges_m.push_back(static_cast<float>(
          room.cast({0.5, 0.5}, T_world_body.theta + bearing, 80.0).value_or(90.0)));
    }
    match = matching.add_scan(LaserId::kFront, scan);
    if (i < 39) T_odom_body = T_odom_body * Pose2{0.0, 0.0, 0.1 * rate};
  }
  return angle_diff(match.T_odom_body.theta, T_odom_body.theta);
}

TEST(ScanMatching, CorrectsSlowScansForTheMotionOfTheBody) {
  EXPECT_GT(std::abs(heading_error_of_slow_laser({.mirror_hz = 1000.0, .mirror_turns = 1})), 0.015);
  EXPECT_LT(std::abs(heading_error_of_slow_laser({.mirror_hz = 10.0, .mirror_turns = 1})), 0.004);
}

TEST(ScanMatching, StartsOdomAtTheFirstScan) {
  SimulatedDrive drive(test::crooked_room(), {-2.0, 0.0, 0.3});
  EXPECT_EQ(drive.first().status, Status::kFirstScan);
  EXPECT_EQ(drive.first().T_odom_body, Pose2{});
}

class ScanMatchingRecovers : public testing::TestWithParam<Pose2> {};

TEST_P(ScanMatchingRecovers, AKnownMotion) {
  SimulatedDrive drive(test::crooked_room(), {-2.0, 0.0, 0.3});
  const ScanMatch match = drive.step(GetParam());
  EXPECT_EQ(match.status, Status::kMatched);
  EXPECT_TRUE(match.degenerate.empty());
  expect_near(match.T_odom_body, drive.truth(), 0.008, 0.002);  // 5 sigma of the match
  expect_near(match.T_reference_body, GetParam(), 0.008, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Motions, ScanMatchingRecovers,
                         testing::Values(Pose2{0.0, 0.0, 0.0}, Pose2{0.2, 0.0, 0.0},
                                         Pose2{0.1, -0.2, 0.0}, Pose2{-0.3, 0.1, 0.1},
                                         Pose2{0.0, 0.0, 0.5}, Pose2{0.4, 0.1, -0.6},
                                         Pose2{0.0, 0.0, -0.9}, Pose2{0.7, 0.0, 0.2}));

TEST(ScanMatching, DriftsLittleOverAFewMetres) {
  SimulatedDrive drive(test::crooked_room(), {-3.0, 0.0, 0.0});
  for (int i = 0; i < 40; ++i) drive.step({0.1, 0.0, 0.01});
  const ScanMatch match = drive.step({});
  expect_near(match.T_odom_body, drive.truth(), 0.01, 0.004);
}

TEST(ScanMatching, CovarianceIsConsistentWithTheError) {
  // The normalised error squared has the expectation 3, its number of dimensions. Over 200 seeds
  // its mean is known to 0.17; the remaining tolerance is for effects outside the model (quantised
  // ranges, corners, surfels shared by several points).
  const test::WallWorld room = test::crooked_room();
  const test::WallWorld workings = test::sample_mine(3);
  for (const int steps : {1, 8}) {
    for (const bool mine : {false, true}) {
      double sum = 0.0;
      constexpr int kSeeds = 200;
      for (int seed = 0; seed < kSeeds; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        const Pose2 start = mine ? Pose2{12.0 + 5.0 * u(random), 0.2 * u(random), 0.1 * u(random)}
                                 : Pose2{-2.0 + u(random), u(random), 3.0 * u(random)};
        SimulatedDrive drive(mine ? workings : room, start, seed + 1);
        ScanMatch match;
        Pose2 step;
        for (int i = 0; i < steps; ++i) {
          step = {0.15 + 0.1 * u(random), 0.02 * u(random), 0.1 * u(random)};
          match = drive.step(step);
        }
        ASSERT_EQ(match.status, Status::kMatched);
        const Eigen::Vector3d error = between(step, match.T_reference_body).vector();
        sum += error.dot(match.covariance.inverse() * error) / kSeeds;
      }
      EXPECT_GT(sum, 1.5) << steps << " steps, mine " << mine;
      EXPECT_LT(sum, 4.5) << steps << " steps, mine " << mine;
    }
  }
}

TEST(ScanMatching, ReportsDegeneracyInAStraightTunnel) {
  for (const double heading : {0.0, 0.05, -0.1}) {
    SimulatedDrive drive(test::straight_tunnel(400.0, 3.0), {0.0, 0.2, heading});
    for (int i = 0; i < 5; ++i) {
      const ScanMatch match = drive.step({0.1, 0.0, 0.0});
      ASSERT_EQ(match.status, Status::kMatched);
      ASSERT_EQ(match.degenerate.size(), 1U);
      const double theta = drive.T_world_body().theta;
      const Eigen::Vector3d axis_body(std::cos(theta), -std::sin(theta), 0.0);
      EXPECT_GT(std::abs(match.degenerate[0].direction.dot(axis_body)), 0.99);
      EXPECT_EQ(match.degenerate[0].fill, DegenerateDirection::Fill::kNone);
      EXPECT_GT(match.covariance(0, 0), 0.25);  // at least half a metre
    }
    // Across the tunnel and in heading the match is certain.
    const ScanMatch match = drive.step({0.0, 0.0, 0.02});
    EXPECT_NEAR(wrap_angle(match.T_odom_body.theta - drive.truth().theta), 0.0, 0.004);
  }
}

TEST(ScanMatching, FillsADegenerateDirectionFromOdometry) {
  SimulatedDrive drive(test::straight_tunnel(400.0, 3.0), {0.0, 0.2, 0.05});
  Pose2 wheels;
  drive.matching().add(WheelOdometry{drive.utime(), wheels});
  ScanMatch match;
  for (int i = 0; i < 50; ++i) {
    wheels = wheels * Pose2{0.1, 0.0, 0.0};
    drive.matching().add(WheelOdometry{drive.utime() + kPeriod, wheels});
    match = drive.step({0.1, 0.0, 0.0});
    ASSERT_EQ(match.degenerate.size(), 1U);
    EXPECT_EQ(match.degenerate[0].fill, DegenerateDirection::Fill::kOdometry);
  }
  expect_near(match.T_odom_body, drive.truth(), 0.05, 0.005);  // 1 % of the path length
  EXPECT_LT(match.covariance(0, 0), 0.01);
}

TEST(ScanMatching, ExtrapolatesUnobservedMotionAtADecayingSpeed) {
  // From the room with its corners into a tunnel: the last observed speed continues and decays.
  SimulatedDrive drive(test::straight_tunnel(400.0, 3.0), {0.0, 0.0, 0.0});
  for (int i = 0; i < 20; ++i) {
    const ScanMatch match = drive.step({0.1, 0.0, 0.0});
    EXPECT_LT(std::abs(match.T_reference_body.x), 0.05);  // no motion is observable
  }
}

TEST(ScanMatching, IsNotDegenerateInARoomOrAMine) {
  SimulatedDrive room(test::crooked_room(), {-2.0, 0.0, 0.3});
  SimulatedDrive mine(test::sample_mine(3), {12.0, 0.0, 0.0});
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(room.step({0.05, 0.0, 0.1}).degenerate.empty());
    EXPECT_TRUE(mine.step({0.1, 0.0, 0.0}).degenerate.empty());
  }
}

TEST(ScanMatching, RejectsScansThatDoNotAdvanceInTime) {
  SimulatedDrive drive(test::crooked_room(), {-2.0, 0.0, 0.3});
  const ScanMatch before = drive.step({0.1, 0.0, 0.0});
  LaserScan scan = drive.measure_scan();
  const ScanMatch again = drive.matching().add_scan(LaserId::kFront, scan);
  scan.utime -= kPeriod;
  const ScanMatch late = drive.matching().add_scan(LaserId::kFront, scan);
  for (const auto& rejected : {again, late}) {
    EXPECT_EQ(rejected.status, Status::kRejected);
    EXPECT_EQ(rejected.T_odom_body, before.T_odom_body);
  }
  expect_near(drive.step({0.1, 0.0, 0.0}).T_odom_body, drive.truth(), 0.008, 0.002);
}

TEST(ScanMatching, IsLostInAnEmptyScanAndRecovers) {
  SimulatedDrive drive(test::crooked_room(), {-2.0, 0.0, 0.3});
  drive.step({0.1, 0.0, 0.0});
  LaserScan blind = drive.measure_scan();
  for (int i = 0; i < 5; ++i) {
    blind.utime += 10'000;
    blind.ranges_m.assign(i == 0 ? 0 : 181, std::numeric_limits<float>::quiet_NaN());
    const ScanMatch match = drive.matching().add_scan(LaserId::kFront, blind);
    EXPECT_EQ(match.status, Status::kLost);
    EXPECT_TRUE(match.covariance.allFinite());
    EXPECT_GT(match.covariance(0, 0), 0.01);
  }
  const ScanMatch match = drive.step({0.1, 0.0, 0.0});
  EXPECT_EQ(match.status, Status::kMatched);
  expect_near(match.T_odom_body, drive.truth(), 0.01, 0.003);
}

TEST(ScanMatching, ResetsTheReferenceInAPlaceThatMatchesNothing) {
  SimulatedDrive drive(test::crooked_room(), {-2.0, 0.0, 0.3});
  test::LevelLaser laser(test::sample_mine(3), 9);
  std::int64_t utime = drive.utime();
  int lost = 0;
  ScanMatch match;
  for (int i = 0; i < 8; ++i) {
    utime += kPeriod;
    match = drive.matching().add_scan(LaserId::kFront,
                                      laser.measure({40.0 + 0.1 * i, 0.0, 0.0}, utime));
    lost += match.status == Status::kLost ? 1 : 0;
  }
  EXPECT_GE(lost, 1);
  EXPECT_LE(lost, 4);
  EXPECT_EQ(match.status, Status::kMatched);
}

TEST(ScanMatching, ToleratesInvalidReadings) {
  SimulatedDrive drive(test::crooked_room(), {-2.0, 0.0, 0.3});
  drive.step({0.1, 0.0, 0.0});
  LaserScan scan = drive.measure_scan();
  scan.utime += kPeriod;
  std::mt19937 random(3);
  for (float& range : scan.ranges_m) {  // a fifth of the readings is invalid
    switch (random() % 15) {
      case 0:
        range = std::numeric_limits<float>::quiet_NaN();
        break;
      case 1:
        range = std::numeric_limits<float>::infinity();
        break;
      case 2:
        range = 81.83F;
        break;
      default:
        break;
    }
  }
  const ScanMatch match = drive.matching().add_scan(LaserId::kFront, scan);
  EXPECT_EQ(match.status, Status::kMatched);
  expect_near(match.T_odom_body, drive.truth(), 0.01, 0.003);
}

TEST(ScanMatching, MatchesTheRearLaserToo) {
  const test::WallWorld room = test::crooked_room();
  test::LevelLaser front(room, 1);
  test::LevelLaser rear(room, 2);
  ScanMatching matching{ScanMatchingParams{}};
  const Pose2 start{-1.0, 0.0, 0.3};
  const Pose2 T_body_rear{0.0, 0.0, std::numbers::pi};
  Pose2 truth;
  ScanMatch match;
  for (int i = 0; i < 20; ++i) {
    const Pose2 T_world_body = start * truth;
    const std::int64_t utime = kStart + i * kPeriod;
    matching.add_scan(LaserId::kFront, front.measure(T_world_body, utime));
    match = matching.add_scan(LaserId::kRear, rear.measure(T_world_body * T_body_rear, utime));
    EXPECT_NE(match.status, Status::kRejected);  // both measured at one time
    if (i < 19) truth = truth * Pose2{0.05, 0.0, 0.05};
  }
  EXPECT_EQ(match.status, Status::kMatched);
  expect_near(match.T_odom_body, truth, 0.01, 0.003);
}

TEST(ScanMatching, IgnoresSpinningWheels) {
  SimulatedDrive drive(test::crooked_room(), {-3.0, 0.0, 0.0});
  Pose2 wheels;
  drive.matching().add(WheelOdometry{drive.utime(), wheels});
  ScanMatch match;
  for (int i = 0; i < 20; ++i) {
    wheels = wheels * Pose2{0.3, 0.0, 0.1};  // the body stands
    drive.matching().add(WheelOdometry{drive.utime() + kPeriod, wheels});
    match = drive.step({});
  }
  expect_near(match.T_odom_body, drive.truth(), 0.01, 0.003);
}

}  // namespace
}  // namespace adit
