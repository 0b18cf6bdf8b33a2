// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "procs/driving/driving.hpp"

namespace adit {

/// In:  PATH (planned_path_t); POSE (pose_t); optional SCAN_MATCH (scan_match_t), VEHICLE_STATE
///      (vehicle_state_t), PHASE (phase_t), and LASER_* (planar_lidar_t), TILT_* (tilt_t) for
///      narrow passages.
/// Out: DRIVE_COMMAND (drive_command_t), each kCommandPeriodUs, also to stand, so that missing
///      commands show that driving has failed; DRIVING_STATE (driving_state_t), in each fourth
///      cycle and immediately when its kind, its reason or the path changes.
class DrivingNode {
 public:
  using Params = DrivingParams;

  static constexpr std::int64_t kCommandPeriodUs = 50'000;

  /// Throws as Driving does.
  DrivingNode(Bus& bus, const Params& params);

  /// Degraded while the robot waits, a fault if it has left its path or makes no progress.
  [[nodiscard]] Health health() const;

 private:
  void subscribe_laser(LaserId laser, std::string_view scans, std::string_view tilts);
  void drive(std::int64_t utime);
  void publish_state(const DrivingState& state);

  Bus& bus_;
  Driving driving_;
  std::optional<DrivingState> published_;
};

}  // namespace adit
