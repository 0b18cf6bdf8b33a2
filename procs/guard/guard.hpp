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
#include "common/sensing/ground_and_air.hpp"
#include "common/sensing/imu_reading.hpp"
#include "common/sensing/laser_id.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/tilt_reading.hpp"
#include "common/vehicle/drive_command.hpp"
#include "procs/guard/arc_sweep.hpp"
#include "procs/guard/attitude.hpp"
#include "procs/guard/guard_params.hpp"
#include "procs/guard/last_heard.hpp"
#include "procs/guard/steady_time.hpp"
#include "procs/guard/stop_latch.hpp"
#include "procs/guard/surroundings.hpp"
#include "procs/guard/way_back.hpp"

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

  void hear(LaserId laser, const LaserScan& scan, std::int64_t now);
  void hear(LaserId laser, const TiltReading& reading, std::int64_t now);
  void hear(const DriveCommand& command, std::int64_t now);
  void hear(const VehicleState& state, std::int64_t now);
  void hear(const ImuReading& reading, std::int64_t now);
  void hear(const GasReading& reading, std::int64_t now);
  void hear(const SinkageReading& reading, std::int64_t now);
  void hear_pose(const Pose2& T_odom_body, std::int64_t utime, std::int64_t now);
  void hear_supervisor(std::int64_t utime, std::int64_t now);

  /// Looks at everything once more: whether the vehicle is to stand now, and why.
  StopOrder judge(std::int64_t now);

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
  [[nodiscard]] ArcMotion commanded() const;
  [[nodiscard]] ArcMotion rolling() const;

  GuardParams params_;
  SteadyTime time_;
  Surroundings surroundings_;
  Attitude attitude_;
  LastHeard command_heard_, state_heard_, imu_heard_, gas_heard_, sinkage_heard_, pose_heard_,
      supervisor_heard_;
  DriveCommand command_;
  VehicleState state_;
  GasReading gas_;
  SinkageReading sinkage_;
  WayBack out_of_tilt_, out_of_mud_, out_of_gas_;
  StopLatch latch_;
  std::vector<StopReason> reasons_;
  std::string told_ = "nothing heard yet";  ///< the last reasons that there were
  std::array<bool, kStopKindNames.size()> held_{};
  std::array<std::int64_t, kStopKindNames.size()> counts_{};
};

}  // namespace adit
