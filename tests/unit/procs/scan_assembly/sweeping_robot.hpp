// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "procs/scan_assembly/scan_assembly.hpp"
#include "sim/simulation/simulation_params.hpp"
#include "sim/simulation/tilting_laser.hpp"
#include "tests/support/robots/simulated_robot.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit::test {

inline constexpr std::int64_t kStart = 1'600'000'000'000'000;

/// A laser without errors, with a range of 8 m and a resolution of 1 mm.
inline LaserParams perfect_laser() {
  LaserParams params;
  params.unit_m = 0.001;
  params.range_at_10_percent_m = 10'000.0;
  params.noise_sd_m = 0.0;
  params.offset_max_m = 0.0;
  return params;
}

inline ScanAssemblyParams assembly_params() {
  auto params = with_groundhog_lasers<ScanAssemblyParams>();
  params.lasers.front.range_max_m = 8.0;  // no return of perfect_laser() reads 8.191 m
  return params;
}

/// A body with a tilting front laser, and all input of the assembly, in steps of 10 ms. The frame
/// odom is world.
class SweepingRobot {
 public:
  using PoseAt = std::function<Eigen::Isometry3d(double seconds)>;

  explicit SweepingRobot(
      World world, const LaserParams& laser = perfect_laser(),
      PoseAt T_world_body = [](double) { return Eigen::Isometry3d::Identity(); })
      : site_(std::move(world)),
        T_world_body_(std::move(T_world_body)),
        laser_(site_.scene(), setup(laser), kStart, T_world_body_(0.0)) {}

  // Whether data reaches the assembly, by seconds since the start.
  std::function<bool(double)> delivers_scans = [](double) { return true; };
  std::function<bool(double)> delivers_tilts = [](double) { return true; };
  std::function<bool(double)> delivers_commands = [](double) { return true; };
  bool has_imu = true;
  Attitude pose_attitude;         ///< of the poses
  bool swaps_tilt_order = false;  ///< of each two readings the second arrives first

  /// The cloud of a request after 2 s of rest, if it is published within `seconds`.
  std::optional<Cloud> sweep(ScanAssembly& assembly, double seconds = 12.0) {
    std::optional<Cloud> cloud;
    for (int step = 1; step <= std::lround(seconds * 100.0); ++step) {
      advance(assembly, step);
      if (step == 200) assembly.begin({utime_, 7, LaserId::kFront}, utime_);
      ScanAssembly::Step result = assembly.advance(utime_);
      if (result.command && delivers_commands(seconds_)) laser_.command(*result.command);
      if (result.cloud) cloud = std::move(result.cloud);
    }
    return cloud;
  }

  [[nodiscard]] const RayScene& scene() const { return site_.scene(); }
  [[nodiscard]] double tilt_rad() const { return laser_.tilt_reading().angle_rad; }

 private:
  static TiltingLaser::Setup setup(const LaserParams& laser) {
    TiltParams tilt;
    tilt.encoder_step_rad = 0.0;
    return {groundhog_lasers().front, laser, tilt, 0.0, 1, 2};
  }

  void advance(ScanAssembly& assembly, int step) {
    utime_ = kStart + 10'000 * step;
    seconds_ = 0.01 * step;
    const Eigen::Isometry3d T_world_body = T_world_body_(seconds_);
    laser_.advance(utime_, T_world_body);
    for (const auto& finished : laser_.finished_scans([](std::int64_t) { return true; })) {
      if (delivers_scans(seconds_)) assembly.add(LaserId::kFront, finished.scan);
    }
    if (step % 2 == 0 && delivers_tilts(seconds_)) deliver_tilt(assembly);
    const Eigen::Vector3d p = T_world_body.translation();
    const Eigen::Vector3d x = T_world_body.linear().col(0);
    assembly.add(utime_, Pose2{p.x(), p.y(), std::atan2(x.y(), x.x())}, p.z(), pose_attitude);
    const Eigen::Vector3d up(0.0, 0.0, 9.81);
    if (has_imu) assembly.add(ImuReading{utime_, {}, T_world_body.linear().transpose() * up});
  }

  void deliver_tilt(ScanAssembly& assembly) {
    const TiltReading reading = laser_.tilt_reading();
    if (!swaps_tilt_order) {
      assembly.add(LaserId::kFront, reading);
    } else if (buffer_) {
      assembly.add(LaserId::kFront, reading);
      assembly.add(LaserId::kFront, *buffer_);
      buffer_.reset();
    } else {
      buffer_ = reading;
    }
  }

  Site site_;
  PoseAt T_world_body_;
  TiltingLaser laser_;
  std::int64_t utime_ = kStart;
  double seconds_ = 0.0;
  std::optional<TiltReading> buffer_;
};

/// Distance of a point to the nearest surface of an empty tunnel [m].
inline double distance_to_surface(const BoxTunnel& tunnel, const Eigen::Vector3d& p_world) {
  return std::min({std::abs(p_world.z()), std::abs(p_world.z() - tunnel.height_m),
                   std::abs(std::abs(p_world.y()) - tunnel.width_m / 2.0),
                   std::abs(std::abs(p_world.x()) - tunnel.length_m / 2.0)});
}

/// Maximum distance of the points of a cloud to the surfaces [m]; odom is world.
inline double largest_error(const BoxTunnel& tunnel, const Cloud& cloud) {
  double largest = 0.0;
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p_level : line.points) {
      const Eigen::Vector2d p = cloud.T_odom_level * p_level.head<2>().cast<double>();
      largest = std::max(largest,
                         distance_to_surface(tunnel, {p.x(), p.y(), p_level.z() + cloud.z_odom_m}));
    }
  }
  return largest;
}

}  // namespace adit::test
