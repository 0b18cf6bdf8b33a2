// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/attitude_filter.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/vehicle_state.hpp"
#include "procs/guard/guard_params.hpp"
#include "procs/guard/input_staleness.hpp"
#include "procs/guard/obstacle_check.hpp"
#include "procs/guard/stop_release.hpp"
#include "procs/guard/surroundings.hpp"
#include "procs/guard/travel_direction.hpp"

namespace adit {

/// The kinds of reasons to stop, in the order in which they are reported.
enum class StopKind { kObstacle, kLaser, kPose, kCommand, kTilt, kSinkage, kGas, kSupervisor };
inline constexpr std::array<const char*, 8> kStopKindNames{
    "obstacle", "laser", "pose", "command", "tilt", "sinkage", "gas", "supervisor"};

struct StopReason {
  StopKind kind = StopKind::kObstacle;
  std::string text;  ///< with measured values and limits
};

/// The safety monitor of the vehicle. It is independent of all plans: it depends only on sensor
/// data, POSE and the commands to the vehicle. It orders a stop for
/// - an obstacle within the stopping distance on the commanded arc or on the measured one;
/// - stale data: the laser in the direction of motion, pose, commands;
/// - in reverse without a rear laser: ground that neither was seen nor carried the vehicle;
/// - roll, pitch, sinkage and air beyond their limits; a retreat is permitted;
/// - a supervisor whose heartbeat has timed out;
/// - a stop that somebody else on the network orders.
/// It never fails: missing data is a reason to stop.
///
/// `now` is bus time [µs since the epoch], and passed with all data.
class Guard {
 public:
  /// Throws std::invalid_argument if a level laser could see no obstacles, as it is below the
  /// height of a step or above the vehicle; if the blind range of a laser exceeds the obstacle
  /// margin; and if the tilt margin allows no tilt.
  explicit Guard(const GuardParams& params);

  void receive(LaserId laser, const LaserScan& scan, std::int64_t now);
  void receive(LaserId laser, const TiltReading& reading, std::int64_t now);
  void receive(const DriveCommand& command, std::int64_t now);
  void receive(const VehicleState& state, std::int64_t now);
  void receive(const ImuReading& reading, std::int64_t now);
  void receive(const GasReading& reading, std::int64_t now);
  void receive(const SinkageReading& reading, std::int64_t now);
  void receive_pose(const Pose2& T_odom_body, std::int64_t utime, std::int64_t now);
  void receive_supervisor(std::int64_t utime, std::int64_t now);
  /// Only places ground that has carried the vehicle, for reverse motion without a rear laser.
  void receive(const MapCorrection& correction) { surroundings_.receive(correction); }

  /// A stop that another process orders: it holds for kForeignStopS after the last one.
  void receive_stop(std::int64_t now);
  static constexpr double kForeignStopS = 1.0;

  /// Evaluates all reasons: whether the vehicle must stop now, and why.
  StopOrder evaluate(std::int64_t now);

  /// The current reasons; empty while only the release is pending.
  [[nodiscard]] const std::vector<StopReason>& reasons() const { return reasons_; }

  /// The number of times that a reason of each StopKind arose, those at the start included.
  [[nodiscard]] const std::array<std::int64_t, kStopKindNames.size()>& counts() const {
    return counts_;
  }

 private:
  using Text = std::optional<std::string>;

  void add(StopKind kind, Text text);
  void find_reasons();
  void count_new();
  [[nodiscard]] Text obstacle() const;
  [[nodiscard]] Text lasers() const;
  [[nodiscard]] Text tilt() const;
  [[nodiscard]] Text sinkage() const;
  [[nodiscard]] Text gas() const;
  [[nodiscard]] Text supervisor() const;
  [[nodiscard]] Text command() const;
  [[nodiscard]] ArcMotion commanded_motion() const;
  [[nodiscard]] ArcMotion measured_motion() const;

  GuardParams params_;
  MonotonicTime time_;
  Surroundings surroundings_;
  AttitudeFilter attitude_;
  LastReceived command_received_, state_received_, imu_received_, gas_received_, sinkage_received_,
      pose_received_, supervisor_received_, stop_received_;
  DriveCommand command_;
  VehicleState state_;
  GasReading gas_;
  SinkageReading sinkage_;
  TravelDirection travel_;
  RetreatPermission tilt_retreat_, sinkage_retreat_, gas_retreat_;
  StopLatch latch_;
  bool stopped_by_obstacle_ = false;  ///< since the last release
  std::vector<StopReason> reasons_;
  std::string last_reasons_ = "no data received yet";  ///< before the release
  std::array<bool, kStopKindNames.size()> active_{};
  std::array<std::int64_t, kStopKindNames.size()> counts_{};
};

}  // namespace adit
