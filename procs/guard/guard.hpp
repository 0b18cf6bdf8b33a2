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
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/vehicle_state.hpp"
#include "procs/guard/attitude.hpp"
#include "procs/guard/guard_params.hpp"
#include "procs/guard/input_staleness.hpp"
#include "procs/guard/obstacle_check.hpp"
#include "procs/guard/stop_release.hpp"
#include "procs/guard/surroundings.hpp"

namespace adit {

/// What a reason to stand is about, in the order in which reasons are told.
enum class StopKind { kObstacle, kLaser, kPose, kCommand, kTilt, kSinkage, kGas, kSupervisor };
inline constexpr std::array<const char*, 8> kStopKindNames{
    "obstacle", "laser", "pose", "command", "tilt", "sinkage", "gas", "supervisor"};

struct StopReason {
  StopKind kind = StopKind::kObstacle;
  std::string text;  ///< with numbers
};

/// The last word on motion. Whoever drives may be wrong or dead; this depends on nobody's plan,
/// only on what the sensors say and on what the vehicle is told. Stands for an obstacle on the arc
/// that is commanded, or that the vehicle is still on, within the distance in which it can stop;
/// for lasers (those that look where it drives), a pose or commands that are stale; for roll,
/// pitch, sinkage and air beyond their limits, which let it go back where it came from; and for a
/// supervisor that was heard and is no more. Never fails: what it does not know is a reason.
///
/// Times: `now` is bus time [µs since the epoch]; all that is heard must be told with it.
class Guard {
 public:
  /// Throws as `usable` does.
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

  /// Looks at everything once more: whether the vehicle is to stand now, and why.
  StopOrder evaluate(std::int64_t now);

  /// What holds at this time; empty while only the release is waited for.
  [[nodiscard]] const std::vector<StopReason>& reasons() const { return reasons_; }

  /// How often reasons of each StopKind arose, those at the start included.
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
  [[nodiscard]] ArcMotion commanded_motion() const;
  [[nodiscard]] ArcMotion measured_motion() const;

  GuardParams params_;
  MonotonicTime time_;
  Surroundings surroundings_;
  Attitude attitude_;
  LastReceived command_received_, state_received_, imu_received_, gas_received_, sinkage_received_,
      pose_received_, supervisor_received_;
  DriveCommand command_;
  VehicleState state_;
  GasReading gas_;
  SinkageReading sinkage_;
  RetreatPermission tilt_retreat_, sinkage_retreat_, gas_retreat_;
  StopLatch latch_;
  std::vector<StopReason> reasons_;
  std::string last_reasons_ = "nothing heard yet";  ///< the last reasons that there were
  std::array<bool, kStopKindNames.size()> active_{};
  std::array<std::int64_t, kStopKindNames.size()> counts_{};
};

}  // namespace adit
