// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <numbers>
#include <random>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_scan.hpp"
#include "tools/sample_mine/synthetic_world.hpp"

namespace adit {

/// What a planar laser does to the truth. The defaults are those of a SICK LMS 200 at 1°.
struct SyntheticLaserModel {
  int beams = 181;
  double angle_min_rad = -std::numbers::pi / 2.0;
  double angle_step_rad = std::numbers::pi / 180.0;
  /// True bearings, as multiples of those that are reported: whoever matches such scans turns more
  /// or less than the robot does.
  double bearing_scale = 1.0;
  double noise_sd_m = 0.008;  ///< of each range, normal and independent
  double quantum_m = 0.01;    ///< ranges are rounded to multiples of this; 0 for none
  double range_max_m = 80.0;
  double no_return_m = 81.83;  ///< what is reported where nothing is in range
};

/// The LMS 200 at half a degree.
SyntheticLaserModel half_degree_laser();

/// A laser with its own stream of noise: the same seed and the same calls give the same scans.
class SyntheticLaser {
 public:
  SyntheticLaser(const SyntheticLaserModel& model, std::uint64_t seed)
      : model_(model), random_(seed) {}

  LaserScan measure(const SyntheticWorld& world, const Pose2& T_world_laser, std::int64_t utime);

 private:
  float read_range(std::optional<double> true_range_m);

  SyntheticLaserModel model_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace adit
