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
#include "sim/laser/mount_error_params.hpp"
#include "sim/laser/tilt_actuator.hpp"

namespace adit {

/// The recent poses of the body and tilt angles of a laser.
class MotionHistory {
 public:
  struct BodyState {
    std::int64_t utime = 0;
    Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
    double tilt_rad = 0.0;
  };

  explicit MotionHistory(const BodyState& first) : states_{first} {}

  /// Times must increase.
  void add(const BodyState& state) { states_.push_back(state); }
  /// Discards states that interpolation at or after `utime` does not need.
  void discard_before(std::int64_t utime);

  /// The state `seconds` after `utime`, interpolated; clamped to the first and the last state.
  [[nodiscard]] BodyState at(std::int64_t utime, double seconds) const;

 private:
  std::deque<BodyState> states_;
};

/// Start and end times of the scans of one laser, which follow each other without a gap.
class ScanSchedule {
 public:
  /// The first scan begins `phase` periods, 0 to 1, after `start_utime`.
  ScanSchedule(const LaserParams& params, std::int64_t start_utime, double phase);

  [[nodiscard]] std::int64_t begin_utime() const;  ///< first beam of the next scan
  [[nodiscard]] std::int64_t end_utime() const;    ///< its last beam
  /// Whether the next scan is simulated (LaserParams::scan_decimation).
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

/// One tilting laser of the robot: its motor, its scans and their losses.
class TiltingLaser {
 public:
  struct Setup {
    LaserMount mount;
    LaserParams laser;
    TiltParams tilt;
    double phase = 0.0;  ///< offset of its scans, as a fraction of the period
    std::uint64_t noise_seed = 0;
    std::uint64_t loss_seed = 0;
    MountErrorParams error = {};
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
  /// Advances to `utime`, with the pose of the body at that time.
  void advance(std::int64_t utime, const Eigen::Isometry3d& T_world_body);
  /// The scans completed since the last call, without lost ones. A scan is lost unless the laser is
  /// alive at both of its ends.
  std::vector<FinishedScan> finished_scans(const AliveAt& alive);

  [[nodiscard]] TiltReading tilt_reading() const { return tilt_.reading(utime_); }

 private:
  bool is_lost(const AliveAt& alive);
  LaserScan measure();

  LaserMount mount_;  ///< the true one
  double tilt_error_rad_;
  LaserModel laser_;
  TiltActuator tilt_;
  ScanSchedule schedule_;
  MotionHistory history_;
  double scan_loss_;
  std::mt19937_64 loss_random_;
  std::int64_t utime_;
};

}  // namespace adit
