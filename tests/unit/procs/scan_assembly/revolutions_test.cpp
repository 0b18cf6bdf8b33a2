// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// 3D scans of a spinning lidar, without a sweep.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "sim/laser/spinning_lidar_model.hpp"
#include "tests/unit/procs/scan_assembly/sweeping_robot.hpp"

namespace adit {
namespace {

const BoxTunnel kRevolutionTunnel;
constexpr std::int64_t kRevolutionUs = 50'000;

ScanAssemblyParams lidar_params() {
  ScanAssemblyParams params;
  params.lasers.count = 1;
  params.lasers.front.T_body_laser = {0.3, 0.0, 0.0};
  params.lasers.front.height_m = 0.7;
  params.lasers.front.range_max_m = 8.0;
  params.lasers.lidar = {true, 0.21, 900};
  return params;
}

/// A body with a spinning lidar, at a pose by time. The frame odom is world.
class SpinningRobot {
 public:
  using PoseAt = std::function<Eigen::Isometry3d(double seconds)>;

  SpinningRobot(const ScanAssemblyParams& params, PoseAt T_world_body)
      : assembly(params),
        params_(params),
        site_(box_tunnel(kRevolutionTunnel)),
        T_world_body_(std::move(T_world_body)),
        lidar_(site_.scene(), {}, test::perfect_laser(), 1e-6 * kRevolutionUs, 1) {}

  /// The cloud of a request after 2 s, if it is published within a second.
  std::optional<Cloud> scan() { return run(1, 7); }
  /// The cloud of another request, while the robot stands.
  std::optional<Cloud> scan_again() { return run(301, 8); }

  ScanAssembly assembly;
  bool has_lidar = true;
  bool has_imu = true;
  int brakes_until_step = 0;
  Attitude attitude_of_poses;
  double took_s = 0.0;

 private:
  std::optional<Cloud> run(int first_step, int id) {
    for (int step = first_step; step < first_step + 300; ++step) {
      utime_ = test::kStart + 10'000 * step;
      const Eigen::Isometry3d T_world_body = T_world_body_(0.01 * step);
      const Eigen::Vector3d p = T_world_body.translation();
      const Eigen::Vector3d x = T_world_body.linear().col(0);
      assembly.add(utime_, Pose2{p.x(), p.y(), std::atan2(x.y(), x.x())}, p.z(), attitude_of_poses);
      const Eigen::Vector3d up(step < brakes_until_step ? -0.6 : 0.0, 0.0, 9.81);
      if (has_imu) assembly.add(ImuReading{utime_, {}, T_world_body.linear().transpose() * up});
      if (has_lidar && step % 5 == 0) turn(utime_ - kRevolutionUs);
      const int request_step = first_step + 199;
      if (step == request_step) assembly.begin({utime_, id, LaserId::kFront}, utime_);
      const ScanAssembly::Step result = assembly.advance(utime_);
      EXPECT_FALSE(result.command);
      if (result.cloud) {
        took_s = 0.01 * (step - request_step);
        return result.cloud;
      }
    }
    return std::nullopt;
  }

  void turn(std::int64_t utime) {
    const auto T_world_lidar = [&](double seconds) {
      const double since_start_s = 1e-6 * static_cast<double>(utime - test::kStart) + seconds;
      return T_world_body_(since_start_s) * T_body_lidar(params_.lasers);
    };
    assembly.add(lidar_.measure(T_world_lidar, utime, {}));
  }

  ScanAssemblyParams params_;
  Site site_;
  PoseAt T_world_body_;
  SpinningLidarModel lidar_;
  std::int64_t utime_ = 0;
};

Eigen::Isometry3d at(double x, double pitch_rad) {
  return Eigen::Translation3d(x, 0.1, 0.0) * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY());
}

TEST(RevolutionsOfASpinningLidar, MakeA3dScanWithoutASweep) {
  SpinningRobot robot(lidar_params(), [](double) { return at(1.0, 0.0); });
  const auto cloud = robot.scan();
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
  EXPECT_EQ(cloud->id, 7);
  EXPECT_EQ(robot.assembly.problem(), "");
  EXPECT_LE(robot.took_s, 1.05);  // 100 readings of the IMU
  EXPECT_EQ(cloud->lines.size(), 2U * 16U);
  EXPECT_GT(cloud->points(), 20'000U);  // of 28,800, less those farther than 8 m
  EXPECT_LE(test::largest_error(kRevolutionTunnel, *cloud), 0.001);  // half the unit of the laser
}

TEST(RevolutionsOfASpinningLidar, AreLevelledByGravity) {
  SpinningRobot robot(lidar_params(), [](double) { return at(0.0, 0.15); });
  const auto cloud = robot.scan();
  ASSERT_TRUE(cloud);
  EXPECT_LE(test::largest_error(kRevolutionTunnel, *cloud), 0.001);
}

TEST(RevolutionsOfASpinningLidar, AreNotInclinedByBrakingBeforeTheRequest) {
  SpinningRobot robot(lidar_params(), [](double) { return at(0.0, 0.0); });
  robot.brakes_until_step = 200;
  const auto cloud = robot.scan();
  ASSERT_TRUE(cloud);
  EXPECT_LE(test::largest_error(kRevolutionTunnel, *cloud), 0.001);
}

TEST(RevolutionsOfASpinningLidar, AreLevelledByThePoseWithoutImu) {
  SpinningRobot robot(lidar_params(), [](double) { return at(0.0, 0.0); });
  robot.has_imu = false;
  const auto cloud = robot.scan();
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
  EXPECT_LE(test::largest_error(kRevolutionTunnel, *cloud), 0.001);
  EXPECT_NE(robot.assembly.problem(), "");
}

TEST(RevolutionsOfASpinningLidar, ArePlacedByThePoseAtTheirTime) {
  ScanAssemblyParams params = lidar_params();
  params.moved_max_m = 1.0;
  SpinningRobot robot(params, [](double seconds) { return at(0.3 * seconds, 0.0); });
  const auto cloud = robot.scan();
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
  EXPECT_LE(test::largest_error(kRevolutionTunnel, *cloud), 0.002);
}

/// Share of 10 cm cells of the floor within 0.6 m of the line between two x, in level, with a
/// point.
double floor_share(const Cloud& cloud, double from_m, double to_m) {
  const auto columns = static_cast<int>(std::lround((to_m - from_m) / 0.1));
  std::set<std::pair<int, int>> seen;
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      const int column = static_cast<int>(std::floor((p.x() - from_m) / 0.1));
      const int row = static_cast<int>(std::floor((p.y() + 0.6) / 0.1));
      const bool inside = column >= 0 && column < columns && row >= 0 && row < 12;
      if (inside && p.z() < 0.05F) seen.emplace(column, row);
    }
  }
  return static_cast<double>(seen.size()) / (12.0 * columns);
}

/// Drives 3 m within 2 s and stands.
Eigen::Isometry3d driven(double seconds) { return at(std::min(1.5 * seconds, 2.7), 0.0); }

TEST(RevolutionsOfASpinningLidar, ShowTheGroundThatWasPassedAndBetweenTheRings) {
  SpinningRobot robot(lidar_params(), driven);
  const auto cloud = robot.scan();
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
  EXPECT_LE(test::largest_error(kRevolutionTunnel, *cloud), 0.002);
  // Ground near the body, and up to where standing rings are 0.5 m apart.
  EXPECT_GT(floor_share(*cloud, 0.0, 1.5), 0.5);
  EXPECT_GT(floor_share(*cloud, 1.5, 3.5), 0.4);

  ScanAssemblyParams without = lidar_params();
  without.passed_revolutions.count = 0;
  SpinningRobot standing(without, driven);
  const auto rings = standing.scan();
  ASSERT_TRUE(rings);
  EXPECT_LT(floor_share(*rings, 0.0, 1.5), 0.1);
  // Those at rest come first: stages take the place of the first line for that of the scan.
  EXPECT_EQ(cloud->lines.front().origin, rings->lines.front().origin);
}

TEST(RevolutionsOfASpinningLidar, WhileDrivingAreLevelledByThePose) {
  constexpr double kPitchRad = 0.05;
  SpinningRobot robot(lidar_params(),
                      [&](double seconds) { return at(std::min(1.5 * seconds, 2.7), kPitchRad); });
  robot.attitude_of_poses = {0.0, kPitchRad};
  const auto cloud = robot.scan();
  ASSERT_TRUE(cloud);
  EXPECT_GT(cloud->lines.size(), 2U * 16U);
  EXPECT_LE(test::largest_error(kRevolutionTunnel, *cloud), 0.002);
}

TEST(RevolutionsOfASpinningLidar, BelongToOneScanEach) {
  SpinningRobot robot(lidar_params(), driven);
  const auto first = robot.scan();
  const auto second = robot.scan_again();
  ASSERT_TRUE(first);
  ASSERT_TRUE(second);
  EXPECT_GT(first->lines.size(), 2U * 16U);
  EXPECT_EQ(second->lines.size(), 2U * 16U);
}

TEST(RevolutionsOfASpinningLidar, WhileDrivingAreNotUsedWithoutImu) {
  SpinningRobot robot(lidar_params(), driven);
  robot.has_imu = false;
  const auto cloud = robot.scan();
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->lines.size(), 2U * 16U);
}

TEST(RevolutionsOfASpinningLidar, EndIncompleteWhenTheRobotMoves) {
  ScanAssemblyParams params = lidar_params();
  params.revolutions = 20;
  SpinningRobot robot(params, [](double seconds) { return at(0.3 * seconds, 0.0); });
  const auto cloud = robot.scan();
  ASSERT_TRUE(cloud);
  EXPECT_FALSE(cloud->complete);
  EXPECT_EQ(robot.assembly.problem(), "the robot moved");
}

TEST(RevolutionsOfASpinningLidar, TimeOutWithoutALidar) {
  SpinningRobot robot(lidar_params(), [](double) { return at(0.0, 0.0); });
  robot.has_lidar = false;
  EXPECT_FALSE(robot.scan());
  EXPECT_EQ(robot.assembly.problem(), "revolutions of the spinning lidar timed out");
}

}  // namespace
}  // namespace adit
