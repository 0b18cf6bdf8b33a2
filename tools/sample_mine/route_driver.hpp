// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "tools/eval/trajectory.hpp"

namespace adit {

struct DriveModel {
  double speed_m_s = 0.8;
  double yaw_rate_max_rad_s = 0.8;
  double lookahead_m = 1.5;
  double period_s = 0.2;  ///< between poses
};

/// The path of a vehicle that follows waypoints by pure pursuit, from rest at the first and looking
/// at the second, to the last. Times count from `start_utime`. The vehicle moves on exact arcs; it
/// cuts corners by about the look-ahead.
Trajectory drive_route(const std::vector<Eigen::Vector2d>& waypoints, const DriveModel& model,
                       std::int64_t start_utime);

}  // namespace adit
