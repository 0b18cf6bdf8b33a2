// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_id.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/tilt_reading.hpp"
#include "procs/guard/arc_sweep.hpp"
#include "procs/guard/flank_memory.hpp"
#include "procs/guard/guard_params.hpp"
#include "procs/guard/laser_watch.hpp"

namespace adit {

/// What is around the vehicle, as both lasers say it, and whether something is in its way. All
/// times are by SteadyTime.
class Surroundings {
 public:
  explicit Surroundings(const GuardParams& params);

  void hear(LaserId laser, const TiltReading& reading, std::int64_t at_us);
  void hear(LaserId laser, const LaserScan& scan, std::int64_t at_us,
            const Eigen::Vector3d& up_body);
  void move_to(const Pose2& T_odom_body) { flanks_.move_to(T_odom_body); }

  /// Something nearer than it takes to stop; `arc` is for people. Nothing for a motion of no speed.
  [[nodiscard]] std::optional<std::string> obstacle_on(const ArcMotion& motion, const char* arc,
                                                       std::int64_t now_us) const;

  /// Why the laser that looks ahead, or behind in reverse, is not to be relied on. Nothing for a
  /// motion of no speed.
  [[nodiscard]] std::optional<std::string> blindness_on(const ArcMotion& motion,
                                                        std::int64_t now_us) const;

 private:
  [[nodiscard]] LaserWatch& of(LaserId laser) { return laser == LaserId::kFront ? front_ : rear_; }

  Vehicle vehicle_;
  ObstacleParams obstacle_;
  double timeout_s_;
  LaserWatch front_;
  LaserWatch rear_;
  FlankMemory flanks_;
};

}  // namespace adit
