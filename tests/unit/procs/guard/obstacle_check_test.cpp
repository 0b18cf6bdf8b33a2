// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/obstacle_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"
#include "tests/support/robots/chamfered_vehicle.hpp"

namespace adit {
namespace {

constexpr double kNoContact = std::numeric_limits<double>::infinity();
constexpr double kStepM = 0.001;
constexpr double kReachM = 3.0;

/// The pose after a distance along a circle, with four-wheel steering.
Pose2 pose_after(double distance_m, double curvature) {
  if (curvature == 0.0) return {distance_m, 0.0, 0.0};
  const double turn = distance_m * curvature;
  return {std::sin(turn) / curvature, (1.0 - std::cos(turn)) / curvature, turn};
}

/// Distance of a point from the footprint at a pose of the vehicle, whose corners are cut by
/// `cut_m`; negative inside.
double outside_m(const Vehicle& vehicle, double cut_m, double side_margin_m, const Pose2& T,
                 const Eigen::Vector2d& p) {
  const Eigen::Vector2d q = (T.inverse() * p).cwiseAbs();
  const double x_m = q.x() - 0.5 * vehicle.length_m;
  const double y_m = q.y() - 0.5 * vehicle.width_m - side_margin_m;
  return std::max({x_m, y_m, (x_m + y_m + cut_m) / std::numbers::sqrt2});
}

double stepped_distance_m(const Vehicle& vehicle, double cut_m, double side_margin_m,
                          const ArcMotion& motion, const Eigen::Vector2d& p) {
  const double sign = std::copysign(1.0, motion.speed_m_s);
  for (int i = 0; i * kStepM < kReachM; ++i) {
    const Pose2 T = pose_after(sign * i * kStepM, motion.curvature_1_m);
    if (outside_m(vehicle, cut_m, side_margin_m, T, p) <= 0.0) return i * kStepM;
  }
  return kNoContact;
}

struct Comparison {
  int met = 0;
  int grazed = 0;  // met for less than a step
};

/// Compares the distance to random points by the closed form with that by small steps.
Comparison compare(const ArcMotion& motion, double cut_m, std::uint32_t seed) {
  const Vehicle vehicle = cut_m > 0.0 ? chamfered({}, cut_m) : Vehicle{};
  constexpr double kMarginM = 0.05;
  const ArcSweep sweep(vehicle, motion, kMarginM);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-3.5, 3.5);
  Comparison comparison;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d p(coordinate(random), coordinate(random));
    const bool in_margin = outside_m(vehicle, cut_m, kMarginM, {}, p) <= 0.0;
    const double margin_m = in_margin ? 0.0 : kMarginM;
    if (outside_m(vehicle, cut_m, 0.0, {}, p) <= 0.0) continue;
    const double distance_m = sweep.distance_m(p);
    if (in_margin && distance_m == 0.0) continue;  // the vehicle turns towards it
    const double stepped_m = stepped_distance_m(vehicle, cut_m, margin_m, motion, p);
    EXPECT_LE(distance_m, stepped_m + 1e-9) << p.transpose();  // rounding
    if (distance_m >= kReachM - kStepM) continue;
    ++comparison.met;
    EXPECT_LE(p.norm(), sweep.reach_m(distance_m) + 1e-9);
    const Pose2 T = pose_after(std::copysign(distance_m, motion.speed_m_s), motion.curvature_1_m);
    EXPECT_NEAR(outside_m(vehicle, cut_m, margin_m, T, p), 0.0, 1e-6)
        << p.transpose();  // a curvature of 1e-7 counts as straight
    if (stepped_m > distance_m + kStepM + 1e-9) ++comparison.grazed;
  }
  return comparison;
}

TEST(ArcSweep, AgreesWithSmallSteps) {
  std::uint32_t seed = 1;
  for (const double speed : {0.4, -0.4}) {
    for (const double curvature : {0.0, 1e-7, 0.05, -0.05, 0.3, -0.3, 0.625, -0.625}) {
      for (const double cut_m : {0.0, 0.1, 0.4}) {
        const Comparison comparison = compare({speed, curvature}, cut_m, seed++);
        EXPECT_GT(comparison.met, 40) << speed << " " << curvature << " " << cut_m;
        EXPECT_LE(comparison.grazed, 5) << speed << " " << curvature;  // at a corner
      }
    }
  }
}

TEST(ArcSweep, IncludesTheSwingOfTheOuterRearCorner) {
  const Vehicle vehicle;                      // 2.4 × 1.2 m, turning radius 1.6 m
  const Eigen::Vector2d beside(-1.3, -0.65);  // behind the rear, right of the flank
  EXPECT_EQ(ArcSweep(vehicle, {0.4, 0.0}, 0.0).distance_m(beside), kNoContact);
  const Eigen::Vector2d at_the_rear(-0.9,
                                    -0.65);  // on the inner side: met from behind, after a turn
  EXPECT_GT(ArcSweep(vehicle, {0.4, -0.6}, 0.0).distance_m(at_the_rear), 5.0);
  // It is closer to the centre of rotation than the corner.
  const double distance_m =
      ArcSweep(vehicle, {0.4, 0.6}, 0.0).distance_m(Eigen::Vector2d(-1.0, -0.65));
  EXPECT_GT(distance_m, 0.0);
  EXPECT_LT(distance_m, 0.2);
}

TEST(ArcSweep, AllowsToContinueBesideAnObstacleWithinTheMargin) {
  const Vehicle vehicle;
  const Eigen::Vector2d beside(0.5, 0.62);
  EXPECT_EQ(ArcSweep(vehicle, {0.4, 0.0}, 0.05).distance_m(beside), kNoContact);
  EXPECT_LT(ArcSweep(vehicle, {0.4, 0.6}, 0.05).distance_m(beside),
            0.3);  // but not into the obstacle
  EXPECT_GT(ArcSweep(vehicle, {0.4, -0.1}, 0.05).distance_m(beside),
            1.0);  // nor with the rear into it
}

/// Side slip takes the vehicle nearer than the arc says.
TEST(ArcSweep, DoesNotTurnTowardsAnObstacleWithinTheMargin) {
  const Vehicle vehicle;
  const Eigen::Vector2d at_the_front(1.0, 0.605);
  const auto distance_m = [&](double speed_m_s, double curvature_1_m) {
    return ArcSweep(vehicle, {speed_m_s, curvature_1_m}, 0.01).distance_m(at_the_front);
  };
  EXPECT_EQ(distance_m(0.05, 0.05), 0.0);
  EXPECT_GT(distance_m(0.05, -0.05), 1.0);
  EXPECT_EQ(distance_m(-0.05, -0.05), 0.0);  // in reverse the front swings out
  EXPECT_GT(distance_m(-0.05, 0.05), 1.0);
  EXPECT_GT(distance_m(0.05, 0.005), 0.15);  // an error of the steering
}

TEST(ArcSweep, AllowsToLeaveAnObstacleInsideTheFootprint) {
  const Vehicle vehicle;
  const Eigen::Vector2d in_the_front(1.15, 0.3);
  EXPECT_EQ(ArcSweep(vehicle, {0.4, 0.2}, 0.05).distance_m(in_the_front), 0.0);
  EXPECT_EQ(ArcSweep(vehicle, {-0.4, 0.2}, 0.05).distance_m(in_the_front), kNoContact);
}

TEST(ArcSweep, ClampsTheCurvatureToThatOfTheVehicle) {
  const Vehicle vehicle;
  const Eigen::Vector2d ahead(1.8, 0.7);
  const double most_m =
      ArcSweep(vehicle, {0.4, 1.0 / vehicle.turning_radius_m}, 0.0).distance_m(ahead);
  EXPECT_LT(most_m, 1.0);
  EXPECT_EQ(ArcSweep(vehicle, {0.4, 50.0}, 0.0).distance_m(ahead), most_m);
}

/// The same by small steps for a vehicle whose rear axle moves along its x axis.
double stepped_distance_of_ackermann_m(const Vehicle& vehicle, const ArcMotion& motion,
                                       const Eigen::Vector2d& p) {
  const double back = -0.5 * vehicle.wheelbase_m;
  const double radius = 1.0 / motion.curvature_1_m;  // of the body's origin
  const double axle_radius = std::copysign(std::sqrt(radius * radius - back * back), radius);
  const Pose2 T_body_axle{back, 0.0, 0.0};
  const double sign = std::copysign(1.0, motion.speed_m_s);
  for (int i = 0; i * kStepM < kReachM; ++i) {
    const double turn = sign * i * kStepM * motion.curvature_1_m;
    const Pose2 step{axle_radius * std::sin(turn), axle_radius * (1.0 - std::cos(turn)), turn};
    const Pose2 T = T_body_axle * step * T_body_axle.inverse();
    if (outside_m(vehicle, 0.0, 0.0, T, p) <= 0.0) return i * kStepM;
  }
  return kNoContact;
}

TEST(ArcSweep, RotatesAboutTheLineOfTheRearAxleWithAckermannSteering) {
  Vehicle vehicle;
  vehicle.steering = "ackermann";
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-2.5, 2.5);
  int met = 0;
  for (const ArcMotion motion : {ArcMotion{0.4, 0.4}, ArcMotion{0.4, -0.4}, ArcMotion{-0.4, 0.4}}) {
    const ArcSweep sweep(vehicle, motion, 0.0);
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector2d p(coordinate(random), coordinate(random));
      if (outside_m(vehicle, 0.0, 0.0, {}, p) <= 0.0) continue;
      const double stepped_m = stepped_distance_of_ackermann_m(vehicle, motion, p);
      EXPECT_LE(sweep.distance_m(p), stepped_m + 1e-9);
      if (stepped_m == kNoContact) continue;
      ++met;
      EXPECT_NEAR(sweep.distance_m(p), stepped_m, 20 * kStepM) << p.transpose();  // at a corner
    }
  }
  EXPECT_GT(met, 100);
}

TEST(SideMargin, GrowsWithTheSpeedAndLeavesRoomForErrors) {
  const ObstacleParams params;
  EXPECT_DOUBLE_EQ(side_margin_m(params, 0.5), params.side_margin_m);
  EXPECT_DOUBLE_EQ(side_margin_m(params, -0.5), params.side_margin_m);
  EXPECT_DOUBLE_EQ(side_margin_m(params, 0.0), params.side_margin_min_m);
  // Driving creeps up to a clearance of 0.03 m, and drives at 0.5 m/s from 0.15 m on.
  EXPECT_DOUBLE_EQ(side_margin_m(params, 0.05), params.side_margin_min_m);
  for (const double clearance_m : {0.045, 0.06, 0.1, 0.15}) {
    const double speed_m_s = 0.5 * (clearance_m - 0.03) / 0.12;
    EXPECT_GE(clearance_m - side_margin_m(params, speed_m_s), 0.03) << clearance_m;
  }
}

TEST(DistanceToObstacle, NeedsTwoNeighbouringBeams) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const ArcSweep sweep(Vehicle{}, {0.4, 0.0}, 0.05);
  const auto distance_m = [&](const std::vector<double>& x_m) {  // of beams straight ahead
    LaserPoints points;
    for (const double x : x_m) points.p_body.emplace_back(x, 0.0);
    return distance_to_obstacle_m(points, sweep, 2.0);
  };
  const double front_m = 0.5 * Vehicle{}.length_m;
  EXPECT_EQ(distance_m({kNan, 2.05, kNan, 2.05, kNan}), kNoContact);
  EXPECT_NEAR(distance_m({9.0, 2.05, 2.05, 9.0}), 2.05 - front_m, 1e-9);
  EXPECT_NEAR(distance_m({9.0, 1.55, 2.05, 9.0}), 2.05 - front_m, 1e-9);  // the farther of two
  EXPECT_EQ(distance_m({}), kNoContact);
  EXPECT_EQ(distance_m({4.0, 4.0}), kNoContact);  // beyond the stopping distance
}

TEST(StoppingDistance, IsTheSumOfReactionAndBraking) {
  const ObstacleParams params{0.1, 0.5, 0.15, 0.05};
  EXPECT_NEAR(stopping_distance_m(params, 0.4, 0.05), 0.4 * 0.15 + 0.16, 1e-12);
  EXPECT_NEAR(stopping_distance_m(params, -0.4, 0.05), 0.4 * 0.15 + 0.16, 1e-12);
  EXPECT_NEAR(stopping_distance_m(params, 0.0, 0.2), 0.0, 1e-12);
}

}  // namespace
}  // namespace adit
