// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/level_view.hpp"
#include "common/sensing/spinning_lidar.hpp"
#include "sim/laser/spinning_lidar_model.hpp"
#include "sim/simulation/tilting_laser.hpp"

namespace adit {

/// The spinning lidar of the robot: its revolutions along the motion of the body, and their level
/// view.
class SpinningLidar {
 public:
  struct Setup {
    Lasers lasers;
    SpinningLidarParams lidar;
    LaserParams laser;
    std::uint64_t noise_seed = 0;
    std::uint64_t loss_seed = 0;
  };
  struct Finished {
    std::int64_t utime = 0;  ///< of its last column
    LaserScan level;
    std::optional<LidarRevolution> revolution;  ///< if all rings were measured
  };
  using AliveAt = TiltingLaser::AliveAt;

  /// `scene` must outlive this.
  SpinningLidar(const RayScene& scene, const Setup& setup, std::int64_t utime,
                const Eigen::Isometry3d& T_world_body);

  /// Advances to `utime`, with the pose of the body at that time.
  void advance(std::int64_t utime, const Eigen::Isometry3d& T_world_body);
  /// The revolutions completed since the last call, without lost ones. One is lost unless the lidar
  /// is alive at both of its ends.
  std::vector<Finished> finished(const AliveAt& alive);

 private:
  [[nodiscard]] std::int64_t begin_utime() const;
  [[nodiscard]] std::int64_t end_utime() const;
  bool is_lost(const AliveAt& alive);
  Finished measure();

  Eigen::Isometry3d T_body_lidar_;
  double period_s_;
  int decimation_;
  SpinningLidarModel model_;
  LevelView level_view_;
  std::vector<bool> level_readings_;
  MotionHistory history_;
  double scan_loss_;
  std::mt19937_64 loss_random_;
  std::int64_t start_utime_;
  std::int64_t utime_;
  std::int64_t revolution_ = 0;
};

}  // namespace adit
