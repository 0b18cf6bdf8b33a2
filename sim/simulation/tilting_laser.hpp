// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "common/sensing/laser_mount.hpp"
#include "sim/laser/laser_model.hpp"
#include "sim/laser/laser_params.hpp"
#include "sim/laser/tilt_actuator.hpp"

namespace adit {

/// Where the body was and how a laser was tilted, not long ago.
class MotionHistory {
 public:
  struct BodyState {
    std::int64_t utime = 0;
    Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
    double tilt_rad = 0.0;
  };

  explicit MotionHistory(const BodyState& first) : states_{first} {}

  /// Later than those before.
  void add(const BodyState& state) { states_.push_back(state); }
  /// Nobody asks any more for what was before that time.
  void discard_before(std::int64_t utime);

  /// Some seconds after `utime`, between the moments that were added; the nearest of them outside.
  [[nodiscard]] BodyState at(std::int64_t utime, double seconds) const;

 private:
  std::deque<BodyState> states_;
};

/// When the scans of one laser begin and end: back to back, one each period.
class ScanSchedule {
 public:
  /// The first scan begins at `start_utime` and `phase` periods, 0 to 1.
  ScanSchedule(const LaserParams& params, std::int64_t start_utime, double phase);

  [[nodiscard]] std::int64_t begin_utime() const;  ///< of the next scan: its first beam
  [[nodiscard]] std::int64_t end_utime() const;    ///< its last beam
  /// Whether it is among those of LaserParams::scan_decimation.
  [[nodiscard]] bool is_selected() const { return scan_ % scan_decimation_ == 0; }
  void advance() { ++scan_; }

 private:
  std::int64_t start_utime_;
  double phase_;
  double period_s_;
  double last_beam_s_;
  std::int64_t scan_decimation_;
  std::int64_t scan_ = 0;
};

/// One tilting laser of the robot: its motor, its scans one after the other, its losses.
class TiltingLaser {
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
  TiltingLaser(const RayScene& scene, const Setup& setup, std::int64_t utime,
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
