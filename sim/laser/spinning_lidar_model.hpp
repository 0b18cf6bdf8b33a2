// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "common/sensing/spinning_lidar.hpp"
#include "sim/laser/laser_params.hpp"
#include "sim/laser/range_finder.hpp"
#include "sim/laser/spinning_lidar_params.hpp"
#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// Simulates the revolutions of a spinning lidar. The same seed and the same calls give the same
/// ranges.
class SpinningLidarModel {
 public:
  /// T_world_lidar at a time after the first column of a revolution [s].
  using PoseAt = std::function<Eigen::Isometry3d(double seconds)>;

  /// `scene` must outlive this. Throws std::invalid_argument if the elevations do not increase.
  SpinningLidarModel(const RayScene& scene, const SpinningLidarParams& params,
                     const LaserParams& laser, double period_s, std::uint64_t seed);

  /// A revolution whose ranges are not measured.
  [[nodiscard]] const LidarRevolution& blank() const { return blank_; }

  /// The revolution whose first column is at `utime`, each column from the pose of the lidar at its
  /// own time. `measured`: the readings that are simulated, column by column; all if it is empty.
  LidarRevolution measure(const PoseAt& T_world_lidar, std::int64_t utime,
                          const std::vector<bool>& measured);

 private:
  const RayScene& scene_;
  LaserParams laser_;
  RangeFinder finder_;
  LidarRevolution blank_;
  std::vector<Eigen::Vector3d> directions_;  ///< in the frame of the lidar, column by column
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::vector<double> offsets_m_;  ///< systematic error of each ring
  std::vector<Ray> rays_;
  std::vector<RayHit> hits_;
};

}  // namespace adit
