// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/level_pose.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// A place that endangers or blocks the robot, as it was observed.
struct Hazard {
  std::string kind;  ///< "water", "low roof", "step", "slope", "drop", "mud", "methane", ..
  double value = 0.0;
  std::string unit;  ///< of the value; empty: the value means nothing
  std::string evidence;
  std::int64_t utime = 0;  ///< [µs since the epoch]
  LevelPose T_odom_centre;
  Eigen::Vector2d size_m{0.0, 0.0};  ///< along the axes of the frame at its centre
};

/// Limit of hazards that are kept of a mission.
inline constexpr std::size_t kHazardsMax = 1000;

/// Gas at the limits of 30 CFR 75.321 to 75.323, at the robot.
std::vector<Hazard> hazards_of(const GasReading& reading, const LevelPose& T_odom_body);
/// Deep sinkage of the wheels, at the robot.
std::vector<Hazard> hazards_of(const SinkageReading& reading, const LevelPose& T_odom_body);
/// Cells that block a path: steps, low roof, slopes. `z_m`: height of odom there.
std::vector<Hazard> hazards_of(const PlannedPath& path, double z_m, const Vehicle& vehicle);

/// Whether so little room above the ground is left by a roof, rather than by an obstacle on the
/// ground or by a rib that overhangs: those begin below the belly, or below what passes for ground
/// (negative).
inline bool is_above_belly(double clearance_m, const Vehicle& vehicle) {
  return clearance_m >= vehicle.belly_clearance_m;
}

/// Joins a hazard with an observation of its kind that it touches, at a pose relative to it.
/// Returns the shift of its centre, or nothing if they are apart or of different kinds.
std::optional<LevelPose> join(Hazard& hazard, const Hazard& observed,
                              const LevelPose& T_hazard_observed);

}  // namespace adit
