// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/driven_path.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr DrivenPath::Limits kLimits{40.0, 15.0, 0.5};
constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;

/// Drives a path at 0.4 m/s.
class Driver {
 public:
  void straight_to(double x, double y, double theta = 0.0) {
    const Eigen::Vector2d from = T_odom_body_.translation();
    const Eigen::Vector2d offset = Eigen::Vector2d(x, y) - from;
    const int steps = static_cast<int>(std::ceil(offset.norm() / 0.05));
    for (int i = 1; i <= steps; ++i) {
      const Eigen::Vector2d p = from + offset * i / steps;
      path.add(utime_ += 125'000, {p.x(), p.y(), theta});
    }
    T_odom_body_ = {x, y, theta};
  }
  /// Turns of a circle to the left from the present place along x.
  void circle(double radius_m, double turns) {
    const Eigen::Vector2d from = T_odom_body_.translation();
    const int steps = static_cast<int>(std::ceil(turns * radius_m * 2.0 * std::numbers::pi / 0.05));
    for (int i = 1; i <= steps; ++i) {
      const double a = 2.0 * std::numbers::pi * turns * i / steps;
      T_odom_body_ = {from.x() + radius_m * std::sin(a), from.y() + radius_m * (1.0 - std::cos(a)),
                      a};
      path.add(utime_ += 125'000, T_odom_body_);
    }
  }

  DrivenPath path{kLimits};

 private:
  std::int64_t utime_ = kStartUtime;
  Pose2 T_odom_body_;
};

double oldest_m(const DrivenPath& path) {
  return path.distance_travelled_m() - path.same_level().front().distance_travelled_m;
}

TEST(DrivenPath, CountsTheDistanceWithoutNoise) {
  DrivenPath path(kLimits);
  std::int64_t utime = kStartUtime;
  for (int i = 0; i < 400; ++i) {
    EXPECT_TRUE(path.add(utime += 25'000, {0.02 * (i % 2), 0.0, 0.005 * (i % 3)}));
  }
  EXPECT_EQ(path.distance_travelled_m(), 0.0);
  for (int i = 0; i < 400; ++i) EXPECT_TRUE(path.add(utime += 125'000, {0.05 * i, 0.0, 0.0}));
  EXPECT_NEAR(path.distance_travelled_m(), 20.0, 0.2);  // one step, and the start
  EXPECT_LE(oldest_m(path), 15.0);
  EXPECT_LE(path.same_level().size(), 151U);
}

TEST(DrivenPath, StaysOnTheSameLevelToAndFro) {
  Driver driver;
  driver.straight_to(4.0, 0.0);
  for (int i = 0; i < 4; ++i) {
    driver.straight_to(1.0, 0.1);
    driver.straight_to(4.0, 0.0);
  }
  EXPECT_NEAR(driver.path.distance_travelled_m(), 28.0, 0.5);
  EXPECT_GT(oldest_m(driver.path), 27.0);
}

/// Out 18 m and back: the start is 36 m of path away, but each place on the path back meets the one
/// on the path out beside it.
TEST(DrivenPath, ReturnsToTheLevelThatItLeft) {
  Driver driver;
  driver.straight_to(18.0, 0.0);
  driver.straight_to(0.0, 0.1);
  EXPECT_GT(oldest_m(driver.path), 35.0);
}

TEST(DrivenPath, ForgetsWhatOdomHasDriftedFrom) {
  Driver driver;
  for (int i = 0; i < 10; ++i) {
    driver.straight_to(4.0, 0.0);
    driver.straight_to(0.0, 0.0);
  }
  EXPECT_LE(oldest_m(driver.path), 40.0);
  EXPECT_GT(oldest_m(driver.path), 39.0);
}

/// A ramp that turns in a full circle passes above its own beginning.
TEST(DrivenPath, DoesNotMeetTheLevelBelowAHelix) {
  Driver driver;
  driver.straight_to(3.0, 0.0);
  driver.circle(2.45, 1.0);  // 15.4 m
  EXPECT_LE(oldest_m(driver.path), 15.0);
  driver.circle(2.45, 1.0);
  EXPECT_LE(oldest_m(driver.path), 15.0);
}

/// A loop that is too short for a level above: both its ends are the same ground.
TEST(DrivenPath, ClosesALoopThatCannotClimbAboveItself) {
  Driver driver;
  driver.straight_to(6.0, 0.0);
  driver.circle(2.0, 1.0);  // 12.6 m
  driver.straight_to(8.0, 0.0);
  EXPECT_GT(oldest_m(driver.path), 20.0);
}

TEST(DrivenPath, IsResetByAJumpOfOdom) {
  DrivenPath path(kLimits);
  EXPECT_TRUE(path.add(kStartUtime, {}));
  EXPECT_FALSE(path.add(kStartUtime + 100'000, {3.0, 0.0, 0.0}));
  EXPECT_EQ(path.same_level().size(), 1U);
  EXPECT_FALSE(path.add(kStartUtime + 200'000, {3.0, 0.0, 1.5}));
  EXPECT_TRUE(path.add(kStartUtime + 10'000'000, {6.0, 0.0, 1.5}));  // ten seconds without poses
}

TEST(DrivenPath, IsResetByANewOdomFrame) {
  constexpr std::int64_t kOdomUtime = kStartUtime + 1'000'000;
  DrivenPath path(kLimits);
  for (int i = 0; i < 20; ++i) path.add(kOdomUtime - 1'000'000 + 50'000 * i, {0.12 * i, 0.0, 0.0});
  EXPECT_TRUE(path.add(kOdomUtime, {2.28, 0.2, 0.0}));  // no jump
  ASSERT_EQ(path.same_level().size(), 21U);
  EXPECT_TRUE(path.reset(kOdomUtime));
  ASSERT_EQ(path.same_level().size(), 1U);  // the first one in the new odom frame
  EXPECT_FALSE(path.reset(kOdomUtime));
  path.anchor({0.0, 0.2, 0.0});
  ASSERT_EQ(path.same_level().size(), 21U);
  EXPECT_EQ(path.same_level().front().T_odom_body, (Pose2{0.0, 0.2, 0.0}));
}

}  // namespace
}  // namespace adit
