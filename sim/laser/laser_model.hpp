// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "common/sensing/laser_scan.hpp"
#include "sim/laser/laser_params.hpp"
#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// Makes the scans of one laser, with a stream of noise of its own: the same seed and the same
/// calls give the same scans. Beams run counter-clockwise from −90° to 90°.
class LaserModel {
 public:
  /// Pose of the laser in world, some seconds after the first beam of a scan.
  using PoseAt = std::function<Eigen::Isometry3d(double seconds)>;

  /// `scene` must outlive this.
  LaserModel(const RayScene& scene, const LaserParams& params, std::uint64_t seed);

  /// The scan whose first beam is at `utime`. Each beam starts from where the laser is at its own
  /// time (ScanTiming).
  LaserScan measure(const PoseAt& T_world_laser, std::int64_t utime);

  /// Drawn once, in the bounds of LaserParams::offset_max_m [m].
  [[nodiscard]] double offset_m() const { return offset_m_; }

 private:
  const RayScene& scene_;
  LaserParams params_;
  std::mt19937_64 random_;
  double offset_m_ = 0.0;
};

}  // namespace adit
