// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "procs/guard/blind_side_memory.hpp"
#include "procs/guard/flank_memory.hpp"
#include "procs/guard/guard_params.hpp"
#include "procs/guard/laser_monitor.hpp"
#include "procs/guard/obstacle_check.hpp"

namespace adit {

/// The obstacles around the vehicle by the lasers and the flank memory, and whether they block a
/// motion. Times are in MonotonicTime.
class Surroundings {
 public:
  explicit Surroundings(const GuardParams& params);

  void receive(LaserId laser, const TiltReading& reading, std::int64_t at_us);
  void receive(LaserId laser, const LaserScan& scan, std::int64_t at_us,
               const Eigen::Vector3d& up_body);
  void move_to(const Pose2& T_odom_body);
  /// Places what the vehicle has driven over, for motions to its blind side.
  void receive(const MapCorrection& correction);

  /// The obstacle within the stopping distance, as text; nothing without one or at zero speed.
  /// `arc` names the motion in that text. `for_release`: within the stopping distance and the
  /// margin that a release needs.
  [[nodiscard]] std::optional<std::string> obstacle_on(const ArcMotion& motion, const char* arc,
                                                       bool for_release, std::int64_t now_us) const;

  /// Why the laser in the direction of the motion cannot be relied on; nothing at zero speed. In
  /// reverse without a rear laser: the fault of the front one, or, unless it is the level view of a
  /// spinning lidar, ground that is not known to be free within the stopping distance.
  [[nodiscard]] std::optional<std::string> laser_fault_on(const ArcMotion& motion,
                                                          std::int64_t now_us) const;

 private:
  [[nodiscard]] LaserMonitor& monitor_of(LaserId laser) {
    return laser == LaserId::kFront ? front_ : rear_;
  }

  Vehicle vehicle_;
  ObstacleParams obstacle_;
  double timeout_s_;
  LaserMonitor front_;
  LaserMonitor rear_;
  bool has_rear_;
  FlankMemory flank_memory_;
  std::optional<BlindSideMemory> blind_side_memory_;  ///< if no scan shows what is behind
};

}  // namespace adit
