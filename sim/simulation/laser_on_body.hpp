// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "common/sensing/laser_mount.hpp"
#include "sim/laser/laser_model.hpp"
#include "sim/laser/tilt_actuator.hpp"
#include "sim/simulation/motion_history.hpp"
#include "sim/simulation/scan_schedule.hpp"

namespace adit {

/// One tilting laser of the robot: its motor, its scans one after the other, its losses.
class LaserOnBody {
 public:
  struct Setup {
    LaserMount mount;
    LaserParams laser;
    TiltParams tilt;
    double phase = 0.0;  ///< share of a period by which its scans are late
    std::uint64_t noise_seed = 0;
    std::uint64_t loss_seed = 0;
  };
  struct FinishedScan {
    std::int64_t utime = 0;  ///< of its last beam
    LaserScan scan;
  };
  using AliveAt = std::function<bool(std::int64_t utime)>;

  /// `scene` must outlive this.
  LaserOnBody(const RayScene& scene, const Setup& setup, std::int64_t utime,
              const Eigen::Isometry3d& T_world_body);

  void command(const TiltCommand& command) { tilt_.command(command); }
  /// Time goes on to `utime`, when the body is there.
  void advance(std::int64_t utime, const Eigen::Isometry3d& T_world_body);
  /// Those that have ended since the last call, of which none is lost. A laser must be alive at
  /// both ends of a scan.
  std::vector<FinishedScan> finished_scans(const AliveAt& alive);

  [[nodiscard]] TiltReading tilt_reading() const { return tilt_.reading(utime_); }

 private:
  bool is_lost(const AliveAt& alive);
  LaserScan measure();

  LaserMount mount_;
  LaserModel laser_;
  TiltActuator tilt_;
  ScanSchedule schedule_;
  MotionHistory history_;
  double scan_loss_;
  std::mt19937_64 loss_random_;
  std::int64_t utime_;
};

}  // namespace adit
