// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/synthetic_laser.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

SyntheticLaserModel half_degree_laser() {
  SyntheticLaserModel model;
  model.beams = 361;
  model.angle_step_rad = std::numbers::pi / 360.0;
  return model;
}

LaserScan SyntheticLaser::measure(const SyntheticWorld& world, const Pose2& T_world_laser,
                                  std::int64_t utime) {
  LaserScan scan;
  scan.utime = utime;
  scan.angle_min_rad = model_.angle_min_rad;
  scan.angle_step_rad = model_.angle_step_rad;
  scan.ranges_m.reserve(static_cast<std::size_t>(model_.beams));
  for (int i = 0; i < model_.beams; ++i) {
    const double angle = T_world_laser.theta + model_.bearing_scale * model_.angle_min_rad +
                         i * model_.bearing_scale * model_.angle_step_rad;
    const auto range = world.cast(T_world_laser.translation(), angle, model_.range_max_m);
    scan.ranges_m.push_back(read_range(range));
  }
  return scan;
}

float SyntheticLaser::read_range(std::optional<double> true_range_m) {
  const double noise = model_.noise_sd_m * normal_(random_);  // drawn for each beam, hit or not
  if (!true_range_m) return static_cast<float>(model_.no_return_m);
  double range = std::max(0.0, *true_range_m + noise);
  if (model_.quantum_m > 0.0) range = std::round(range / model_.quantum_m) * model_.quantum_m;
  return static_cast<float>(range);
}

}  // namespace adit
