// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/guard_params.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace adit {
namespace {

void check(const std::string& laser, const LaserMount& mount, const GuardParams& params) {
  const Vehicle& vehicle = params.vehicle;
  if (!(mount.height_m > vehicle.step_max_m && mount.height_m < vehicle.height_m)) {
    throw std::invalid_argument(
        "lasers: " + laser +
        ".height_m must be between vehicle.step_max_m and vehicle.height_m, "
        "or the guard sees no obstacles");
  }
  const double range_end_m = std::abs(mount.T_body_laser.x) + mount.range_min_m;
  if (range_end_m - 0.5 * vehicle.length_m > params.obstacle.margin_m) {
    throw std::invalid_argument(
        "guard: obstacle.margin_m must be at least the blind range of lasers." + laser +
        " ahead of the vehicle");
  }
}

}  // namespace

GuardParams validated(const GuardParams& params) {
  check("front", params.lasers.front, params);
  check("rear", params.lasers.rear, params);
  if (!(params.tilt_margin_rad < params.vehicle.tilt_max_rad)) {
    throw std::invalid_argument("guard: tilt_margin_rad must be less than vehicle.tilt_max_rad");
  }
  return params;
}

}  // namespace adit
