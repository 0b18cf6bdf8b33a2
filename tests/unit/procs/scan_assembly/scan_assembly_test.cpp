// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/scan_assembly.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/procs/scan_assembly/sweeping_robot.hpp"

namespace adit {
namespace {

using test::assembly_params;
using test::kStart;
using test::largest_error;
using test::perfect_laser;
using test::SweepingRobot;

const BoxTunnel kTunnel;

// Half the unit of the laser, and the error of the interpolated tilt while it accelerates:
// 2 rad/s² · (20 ms)² / 8 = 0.1 mrad, over up to 4 m where beams hit floor and roof steeply.
constexpr double kExactM = 0.001;

SweepingRobot::PoseAt at_rest(const Eigen::Isometry3d& T_world_body) {
  return [T_world_body](double) { return T_world_body; };
}

TEST(ScanAssembly, PutsEveryPointOnASurface) {
  SweepingRobot robot(box_tunnel(kTunnel));
  ScanAssembly assembly(assembly_params());
  const auto cloud = robot.sweep(assembly);
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
  EXPECT_EQ(cloud->id, 7);
  EXPECT_EQ(assembly.problem(), "");
  EXPECT_NEAR(static_cast<double>(cloud->lines.size()), 243.0, 4.0);  // 6.4 s and ramps at 37.5 Hz
  EXPECT_GT(cloud->points(), 70'000U);  // of 361 beams less those along the tunnel
  EXPECT_LE(largest_error(kTunnel, *cloud), kExactM);
}

TEST(ScanAssembly, PutsLevelAtTheHeightOfTheBody) {
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  T_world_body.translation().z() = 0.3;
  SweepingRobot robot(box_tunnel(kTunnel), perfect_laser(), at_rest(T_world_body));
  ScanAssembly assembly(assembly_params());
  const auto cloud = robot.sweep(assembly);
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->z_odom_m, 0.3);
  EXPECT_LE(largest_error(kTunnel, *cloud), kExactM);
}

TEST(ScanAssembly, IsAsExactAsTheLaser) {
  SweepingRobot robot(box_tunnel(kTunnel), LaserParams{});
  ScanAssemblyParams params = assembly_params();
  params.lasers = groundhog_lasers();
  ScanAssembly assembly(params);
  const auto cloud = robot.sweep(assembly);
  ASSERT_TRUE(cloud);
  // Offset of up to 15 mm, half a unit of 10 mm, 4.8 standard deviations of 5 mm for 86,000 points.
  EXPECT_LE(largest_error(kTunnel, *cloud), 0.015 + 0.005 + 0.024);
}

TEST(ScanAssembly, LevelsTheCloudOnASlope) {
  const double slope = 5.0 * std::numbers::pi / 180.0;
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(0.0, 1.0, 0.0), Eigen::Vector3d(0.6, 0.8, 0.0)}) {
    Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
    T_world_body.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    T_world_body.rotate(Eigen::AngleAxisd(slope, axis));
    SweepingRobot robot(box_tunnel(kTunnel), perfect_laser(), at_rest(T_world_body));
    ScanAssembly assembly(assembly_params());
    const auto cloud = robot.sweep(assembly);
    ASSERT_TRUE(cloud);
    EXPECT_LE(largest_error(kTunnel, *cloud), kExactM);
  }
}

TEST(ScanAssembly, TakesTheAttitudeOfThePoseWithoutImuReadingsAndReportsIt) {
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  T_world_body.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()));
  SweepingRobot robot(box_tunnel(kTunnel), perfect_laser(), at_rest(T_world_body));
  robot.has_imu = false;
  ScanAssembly assembly(assembly_params());
  const auto cloud = robot.sweep(assembly);
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
  EXPECT_GT(largest_error(kTunnel, *cloud), 0.1);  // 0.1 rad over more than a metre
  SweepingRobot levelled(box_tunnel(kTunnel), perfect_laser(), at_rest(T_world_body));
  levelled.has_imu = false;
  levelled.pose_attitude = {0.0, 0.1};
  ScanAssembly another(assembly_params());
  const auto level_cloud = levelled.sweep(another);
  ASSERT_TRUE(level_cloud);
  EXPECT_LE(largest_error(kTunnel, *level_cloud), kExactM);
  EXPECT_NE(assembly.problem().find("no IMU"), std::string::npos);
}

TEST(ScanAssembly, PlacesBeamsByThePoseAtTheirOwnTime) {
  const auto creeps = [](double seconds) {
    return Eigen::Translation3d(0.003 * seconds, 0.001 * seconds, 0.0) *
           Eigen::AngleAxisd(0.001 * seconds, Eigen::Vector3d::UnitZ());
  };
  SweepingRobot robot(box_tunnel(kTunnel), perfect_laser(),
                      [&](double s) { return Eigen::Isometry3d(creeps(s)); });
  ScanAssembly assembly(assembly_params());
  const auto cloud = robot.sweep(assembly);
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
  EXPECT_LE(largest_error(kTunnel, *cloud), kExactM);
}

TEST(ScanAssembly, SetsTheOriginOfEachLine) {
  SweepingRobot robot(box_tunnel(kTunnel));
  ScanAssembly assembly(assembly_params());
  const auto cloud = robot.sweep(assembly);
  ASSERT_TRUE(cloud);
  const LaserMount mount = groundhog_lasers().front;
  const Eigen::Vector3f axis(static_cast<float>(mount.T_body_laser.x - mount.lever_x_m), 0.0F,
                             static_cast<float>(mount.height_m - mount.lever_z_m));
  const double lever = std::hypot(mount.lever_x_m, mount.lever_z_m);
  for (const CloudLine& line : cloud->lines) EXPECT_NEAR((line.origin - axis).norm(), lever, 1e-5);
  // The laser is farther back while it is tilted up.
  EXPECT_LT(cloud->lines.front().origin.x(), cloud->lines.back().origin.x() - 0.05F);
}

TEST(ScanAssembly, ReportsMisses) {
  SweepingRobot robot(box_tunnel(kTunnel));
  ScanAssembly assembly(assembly_params());
  const auto cloud = robot.sweep(assembly);
  ASSERT_TRUE(cloud);
  std::size_t misses = 0;
  for (const CloudLine& line : cloud->lines) {
    for (const Eigen::Vector3f& direction : line.misses) {
      const auto hit = robot.scene().cast({line.origin, direction}, 100.0F);
      ASSERT_TRUE(hit);
      EXPECT_GT(hit->distance_m, 7.9F);  // 8 m, less the motion of the origin within a line
      ++misses;
    }
  }
  EXPECT_GT(misses, 1000U);
}

TEST(ScanAssembly, HasLinesInOrderOfTime) {
  SweepingRobot robot(box_tunnel(kTunnel));
  ScanAssembly assembly(assembly_params());
  const auto cloud = robot.sweep(assembly);
  ASSERT_TRUE(cloud);
  for (std::size_t i = 1; i < cloud->lines.size(); ++i) {
    EXPECT_NEAR(cloud->lines[i].utime - cloud->lines[i - 1].utime, 26'667, 1);
  }
  EXPECT_LT(cloud->utime - cloud->lines.back().utime, 100'000);
  EXPECT_GT(cloud->utime, cloud->lines.back().utime);
}

TEST(ScanAssembly, ReturnsTheLaserToLevel) {
  SweepingRobot robot(box_tunnel(kTunnel));
  ScanAssembly assembly(assembly_params());
  EXPECT_TRUE(robot.sweep(assembly));
  EXPECT_NEAR(robot.tilt_rad(), 0.0, 1e-6);
}

TEST(ScanAssembly, AcceptsTiltsInAnyOrder) {
  SweepingRobot robot(box_tunnel(kTunnel));
  robot.swaps_tilt_order = true;
  ScanAssembly assembly(assembly_params());
  const auto cloud = robot.sweep(assembly);
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
  EXPECT_LE(largest_error(kTunnel, *cloud), kExactM);
}

TEST(ScanAssembly, RepeatsALostCommand) {
  SweepingRobot robot(box_tunnel(kTunnel));
  robot.delivers_commands = [](double seconds) { return seconds > 2.5; };  // the first is at 2.0 s
  ScanAssembly assembly(assembly_params());
  const auto cloud = robot.sweep(assembly, 14.0);
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
}

}  // namespace
}  // namespace adit
