// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/flank_memory.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

const Eigen::Vector2d kNothing =
    Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

Lasers lasers() {
  Lasers lasers;
  lasers.front.T_body_laser = {1.0, 0.0, 0.0};
  lasers.rear.T_body_laser = {-1.0, 0.0, std::numbers::pi};
  return lasers;
}

class FlankMemoryTest : public testing::Test {
 protected:
  /// Drives and scans; there is one post, hit by two beams, at a point in odom.
  void drive(const Pose2& step, int times, const Eigen::Vector2d& post_odom) {
    for (int i = 0; i < times; ++i) {
      T_odom_body_ = T_odom_body_ * step;
      memory_.move_to(T_odom_body_);
      scan(post_odom);
    }
  }
  void scan(const Eigen::Vector2d& post_odom) {
    const Eigen::Vector2d p = T_odom_body_.inverse() * post_odom;
    memory_.observe(LaserId::kFront, points_of(p, p.x() >= 1.0));
    memory_.observe(LaserId::kRear, points_of(p, p.x() <= -1.0));
  }
  static LaserPoints points_of(const Eigen::Vector2d& p_body, bool visible) {
    const Eigen::Vector2d p = visible ? p_body : kNothing;
    return {{kNothing, p, p + Eigen::Vector2d(0.0, 0.01), kNothing}, {}, 2};
  }

  FlankMemory memory_{Vehicle{}, lasers()};  // 2.4 × 1.2 m
  Pose2 T_odom_body_{3.0, -2.0, 0.7};
  const Pose2 kAhead{0.02, 0.0, 0.0};
};

TEST_F(FlankMemoryTest, StoresAnObstacleWhileTheVehiclePassesIt) {
  const Eigen::Vector2d post = T_odom_body_ * Eigen::Vector2d(1.5, 0.8);
  drive(kAhead, 20, post);
  EXPECT_THAT(memory_.p_body(), IsEmpty());  // in view, 1.1 m ahead
  drive(kAhead, 30, post);
  ASSERT_THAT(memory_.p_body(), Not(IsEmpty()));
  EXPECT_LT((memory_.p_body()[0] - Eigen::Vector2d(0.5, 0.8)).norm(), 0.012);  // the other beam
  drive(kAhead, 70, post);
  EXPECT_THAT(memory_.p_body(), Not(IsEmpty()));  // 0.9 m behind
  drive(kAhead, 10, post);
  EXPECT_THAT(memory_.p_body(), IsEmpty());
}

TEST_F(FlankMemoryTest, StoresAnObstacleInReverseAndInATurn) {
  const Eigen::Vector2d post = T_odom_body_ * Eigen::Vector2d(-1.2, -0.9);
  drive({-0.02, 0.0, 0.004}, 30, post);
  ASSERT_THAT(memory_.p_body(), Not(IsEmpty()));
  const Eigen::Vector2d truth = T_odom_body_.inverse() * post;
  EXPECT_LT((memory_.p_body()[0] - truth).norm(), 0.012);
}

TEST_F(FlankMemoryTest, IgnoresSingleBeams) {
  const Eigen::Vector2d post = T_odom_body_ * Eigen::Vector2d(1.01, 0.8);
  memory_.move_to(T_odom_body_);
  const Eigen::Vector2d p = T_odom_body_.inverse() * post;
  memory_.observe(LaserId::kFront, {{kNothing, p, kNothing, p}, {}, 2});
  drive(kAhead, 10, {100.0, 100.0});
  EXPECT_THAT(memory_.p_body(), IsEmpty());
}

/// A stored point counts alone and for long.
TEST_F(FlankMemoryTest, TakesTheMeanOfNeighbouringBeamsOnAWall) {
  memory_.move_to(T_odom_body_);
  LaserPoints wall;
  for (int i = 0; i < 12; ++i) {
    const double error_m = i % 3 == 1 ? -0.012 : 0.006;  // the mean of three neighbours is 0
    wall.p_body.emplace_back(1.01 + 0.01 * i, 0.65 + error_m);
  }
  memory_.observe(LaserId::kFront, wall);
  memory_.move_to(T_odom_body_ * Pose2{0.2, 0.0, 0.0});  // out of view
  ASSERT_THAT(memory_.p_body(), SizeIs(testing::Ge(3U)));
  int exact = 0;
  for (const Eigen::Vector2d& p : memory_.p_body()) exact += std::abs(p.y() - 0.65) < 1e-9 ? 1 : 0;
  EXPECT_GE(exact, std::ssize(memory_.p_body()) - 1);  // the last beam has one neighbour
}

/// The mean of a post and of the wall behind it would be too far away.
TEST_F(FlankMemoryTest, TakesNoMeanOfBeamsOnTwoSurfaces) {
  memory_.move_to(T_odom_body_);
  LaserPoints post;
  post.p_body = {{1.01, 0.7}, {1.02, 0.65}, {1.03, 0.65}, {1.04, 0.7}};
  memory_.observe(LaserId::kFront, post);
  memory_.move_to(T_odom_body_ * Pose2{0.2, 0.0, 0.0});
  double nearest_m = 1.0;
  for (const Eigen::Vector2d& p : memory_.p_body()) nearest_m = std::min(nearest_m, p.y());
  EXPECT_NEAR(nearest_m, 0.65, 1e-9);
}

TEST_F(FlankMemoryTest, DeletesPointsUnderTheFootprintAndFarAway) {
  const Eigen::Vector2d post = T_odom_body_ * Eigen::Vector2d(1.05, 0.62);
  drive(kAhead, 10, post);
  EXPECT_THAT(memory_.p_body(), Not(IsEmpty()));
  drive({0.0, 0.01, 0.0}, 5, {100.0, 100.0});  // sideways over it
  EXPECT_THAT(memory_.p_body(), IsEmpty());
  const Eigen::Vector2d other = T_odom_body_ * Eigen::Vector2d(1.05, 1.5);
  drive(kAhead, 10, other);
  EXPECT_THAT(memory_.p_body(), Not(IsEmpty()));
  drive({0.0, -0.05, 0.0}, 5, {100.0, 100.0});
  EXPECT_THAT(memory_.p_body(), IsEmpty());
}

TEST_F(FlankMemoryTest, DeletesAllPointsWhenThePoseJumps) {
  drive(kAhead, 10, T_odom_body_ * Eigen::Vector2d(1.05, 0.8));
  EXPECT_THAT(memory_.p_body(), Not(IsEmpty()));
  T_odom_body_.x += 0.6;
  memory_.move_to(T_odom_body_);
  EXPECT_THAT(memory_.p_body(), IsEmpty());
}

TEST_F(FlankMemoryTest, DoesNotGrowWhileTheVehicleStands) {
  const Eigen::Vector2d post = T_odom_body_ * Eigen::Vector2d(1.0, 0.8);
  for (int i = 0; i < 10'000; ++i) drive({0.001 * std::sin(i), 0.001 * std::cos(i), 0.0}, 1, post);
  EXPECT_LE(memory_.p_body().size(), 8U);  // cells that the post may be in
}

TEST_F(FlankMemoryTest, NeedsAPose) {
  memory_.observe(LaserId::kFront, points_of({1.05, 0.8}, true));
  EXPECT_THAT(memory_.p_body(), IsEmpty());
  memory_.move_to({1e200, -1e200, 0.3});  // far away
  memory_.observe(LaserId::kFront, points_of({1.05, 0.8}, true));
}

TEST(FlankMemoryOfASpinningLidar, StoresWhatIsNearerThanItsLeastRange) {
  Lasers around;
  around.count = 1;
  around.front.T_body_laser = {0.3, 0.0, 0.0};
  around.front.range_min_m = 0.5;
  around.lidar.present = true;
  Vehicle vehicle;
  vehicle.length_m = 1.1;
  vehicle.width_m = 0.55;
  FlankMemory memory(vehicle, around);
  const auto see = [&](double x, double y) {
    const Eigen::Vector2d p(x, y);
    const bool visible = (p - Eigen::Vector2d(0.3, 0.0)).norm() >= 0.5;
    const Eigen::Vector2d seen = visible ? p : kNothing;
    memory.observe(LaserId::kFront, {{kNothing, seen, seen + Eigen::Vector2d(0.0, 0.01)}, {}, 2});
  };
  memory.move_to({});
  see(0.75, 0.4);  // a post, 0.60 m from the lidar
  EXPECT_THAT(memory.p_body(), IsEmpty());
  memory.move_to({0.4, 0.0, 0.0});
  see(0.35, 0.4);
  ASSERT_THAT(memory.p_body(), SizeIs(1));  // beside the lidar, where it is blind
  EXPECT_NEAR(memory.p_body().front().x(), 0.35, 0.02);
  memory.move_to({1.0, 0.0, 0.0});
  see(-0.25, 0.4);  // in view again
  EXPECT_THAT(memory.p_body(), IsEmpty());
}

}  // namespace
}  // namespace adit
