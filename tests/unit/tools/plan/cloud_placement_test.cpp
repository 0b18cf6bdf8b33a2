// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/cloud_placement.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace adit {
namespace {

/// Ground at z = 0, a wall at y = 2 and a block beside the origin, with points every 5 cm and a
/// laser 1.5 m above the origin.
PointCloud room() {
  PointCloud cloud;
  for (int i = -60; i <= 60; ++i) {
    for (int k = -60; k <= 40; ++k) {
      const bool block = i > 20 && i < 40 && k > 0 && k < 20;
      cloud.points.emplace_back(0.05 * i, 0.05 * k, block ? 0.4 : 0.0);
      cloud.points.emplace_back(0.05 * i, 2.0, 0.02 * (k + 60));
    }
  }
  cloud.sensor = Eigen::Vector3d(0.0, 0.0, 1.5);
  return cloud;
}

PointCloud moved(PointCloud cloud, const Eigen::Isometry3d& T) {
  for (Eigen::Vector3d& p : cloud.points) p = T * p;
  *cloud.sensor = T * *cloud.sensor;
  return cloud;
}

void expect_same(const Cloud& a, const Cloud& b, float tolerance_m) {
  ASSERT_EQ(a.lines.size(), 1U);
  ASSERT_EQ(a.points(), b.points());
  EXPECT_LT((a.lines[0].origin - b.lines[0].origin).norm(), tolerance_m);
  float worst = 0.0F;
  for (std::size_t i = 0; i < a.points(); ++i) {
    worst = std::max(worst, (a.lines[0].points[i] - b.lines[0].points[i]).norm());
  }
  EXPECT_LT(worst, tolerance_m);
}

TEST(CloudPlacement, EstimatesTheGroundBelowTheLaser) {
  const auto T = Eigen::Isometry3d(Eigen::Translation3d(50.0, -20.0, 7.0));
  expect_same(place_cloud(moved(room(), T), {}), place_cloud(room(), {.ground_m = 0.0}), 1e-5F);
}

TEST(CloudPlacement, SupportsEveryUpAxis) {
  const Cloud expected = place_cloud(room(), {});
  for (const char* up : {"x", "y", "z", "-x", "-y", "-z"}) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = upright(up).transpose();
    EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12) << up;  // a rotation, not a reflection
    expect_same(place_cloud(moved(room(), T), {.up = up}), expected, 1e-5F);
  }
  EXPECT_THROW(upright("w"), std::invalid_argument);
}

TEST(CloudPlacement, PlacesTheVehicleAtTheGivenPose) {
  CloudPlacement placement;
  placement.p_plan_vehicle = Eigen::Vector2d(1.0, -1.0);
  placement.heading_rad = std::numbers::pi / 2.0;
  const Cloud cloud = place_cloud(room(), placement);
  // The vehicle heads along y: the laser is 1 m to its left and 1 m ahead.
  EXPECT_LT((cloud.lines[0].origin - Eigen::Vector3f(1.0F, 1.0F, 1.5F)).norm(), 1e-5F);
}

TEST(CloudPlacement, LevelsTheCloudByTheGround) {
  const Eigen::Isometry3d T = Eigen::Translation3d(0.0, 0.0, 1.5) *
                              Eigen::AngleAxisd(0.1, Eigen::Vector3d(0.6, 0.8, 0.0)) *
                              Eigen::Translation3d(0, 0, -1.5);
  const Cloud cloud = place_cloud(moved(room(), T), {.level = true});
  expect_same(cloud, place_cloud(room(), {}), 0.02F);  // 1 % of the distance to the corners
}

TEST(CloudPlacement, RejectsUnobservedGround) {
  PointCloud above = room();
  above.sensor = Eigen::Vector3d(0.0, 0.0, -1.0);
  EXPECT_THROW(place_cloud(above, {}), std::runtime_error);
  EXPECT_THROW(place_cloud(above, {.ground_m = 0.0}), std::runtime_error);
  PointCloud far = room();
  far.sensor = Eigen::Vector3d(30.0, 0.0, 1.5);
  EXPECT_THROW(place_cloud(far, {}), std::runtime_error);
  EXPECT_THROW(place_cloud(far, {.level = true}), std::runtime_error);
}

TEST(GroundEstimate, IsRobustToOutliersBelowTheGround) {
  PointCloud cloud = room();
  for (int i = 0; i < 40; ++i) cloud.points.emplace_back(0.2 * i - 4.0, -0.3, -3.0);
  EXPECT_NEAR(estimate_ground_height(cloud.points, {0.0, 0.0}, 1.5), 0.0, 1e-9);
}

}  // namespace
}  // namespace adit
