// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/sensing/laser_scan.hpp"
#include "procs/guard/guard.hpp"

namespace adit {

/// In:  LASER_FRONT, LASER_REAR (planar_lidar_t); TILT_FRONT, TILT_REAR (tilt_t); DRIVE_COMMAND
///      (drive_command_t); POSE (pose_t); VEHICLE_STATE (vehicle_state_t); IMU (imu_t); GAS
///      (gas_t); SINKAGE (sinkage_t); HEARTBEAT (heartbeat_t), of the stage supervisor; STOP
///      (stop_t), the stops of others, which need no seal: anybody may stop the robot.
/// Out: STOP (stop_t), when the stop is set or released, when the kinds of reasons change, and each
///      kRepeatPeriodUs, so that a lost datagram is harmless and the vehicle can detect a failure
///      of the guard. Evaluates at each scan, each command and each kEvaluationPeriodUs.
class GuardNode {
 public:
  using Params = GuardParams;

  static constexpr std::int64_t kEvaluationPeriodUs = 50'000;
  static constexpr std::int64_t kRepeatPeriodUs = 100'000;

  /// Throws as Guard does.
  GuardNode(Bus& bus, const Params& params);

  /// Degraded for all reasons except those of the driver (obstacles, commands), with the number of
  /// times that reasons of each kind arose.
  [[nodiscard]] Health health() const;

  [[nodiscard]] const Guard& guard() const { return guard_; }

 private:
  void subscribe_laser(LaserId laser, std::string_view scans, std::string_view tilts);
  void subscribe_motion();
  void subscribe_environment();
  void subscribe_foreign_stops();
  void evaluate();

  Bus& bus_;
  Guard guard_;
  std::deque<std::int64_t> own_utimes_;  ///< of the last orders published, which return
  std::optional<std::int64_t> published_utime_;
  bool published_stopped_ = true;
  std::array<bool, kStopKindNames.size()> published_kinds_{};
};

}  // namespace adit
