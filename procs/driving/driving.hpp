// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/mission/mission_phase.hpp"
#include "common/path/driving_state.hpp"
#include "common/path/planned_path.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/vehicle/drive_command.hpp"
#include "procs/driving/command_ramp.hpp"
#include "procs/driving/driving_params.hpp"
#include "procs/driving/heard_vehicle.hpp"
#include "procs/driving/hold_limit.hpp"
#include "procs/driving/mission_leave.hpp"
#include "procs/driving/path_progress.hpp"
#include "procs/driving/pose_filter.hpp"
#include "procs/driving/pose_trust.hpp"
#include "procs/driving/speed_profile.hpp"
#include "procs/driving/steered_point.hpp"
#include "procs/driving/unmeasured_way.hpp"
#include "procs/driving/wheel_disagreement.hpp"

namespace adit {

/// What driving says at a time.
struct DriveOutput {
  DriveCommand command;
  DrivingState state;
};

/// Drives along paths: where the robot is on its path, how far beside it, how it must be steered
/// and how fast it may go (the paper's section 3.3). It stands while it does not know where it is
/// and goes on when it does; beside its path it stands until it gets a new one. While the vehicle
/// is held it goes on asking to creep, so that who holds it can judge that; if there is no way on
/// for long, it needs a new path, too.
class Driving {
 public:
  /// Throws std::invalid_argument for a vehicle that cannot be steered.
  explicit Driving(const DrivingParams& params);

  /// Takes the place of the path before. Where none was found, or one of more than a kilometre,
  /// there is none to drive.
  void follow(const PlannedPath& path);
  void add_pose(std::int64_t utime, const Pose2& T_odom_body);
  void add_match(const ScanMatch& match);
  /// How fast it truly is, and whether it is held: the newest, as long as it is fresh.
  void add_state(const VehicleState& state);

  /// How the mission stands. Once that was heard, it drives only what the mission is executing, as
  /// long as it is told so.
  void add_phase(const MissionPhase& phase, std::int64_t utime);

  /// The command for now; to be asked at least each 200 ms while it drives.
  DriveOutput drive(std::int64_t utime);

  [[nodiscard]] const DrivingState& state() const { return state_; }

 private:
  using Kind = DrivingState::Kind;

  double seconds_to(std::int64_t utime);
  void trust_or_wait(std::int64_t utime);
  [[nodiscard]] bool is_under_way() const;
  void begin_run();
  void locate(std::int64_t utime);
  void judge(std::int64_t utime, const Pose2& T_odom_steered);
  void fail(const std::string& reason);
  void move(double seconds);
  [[nodiscard]] double speed_here() const;
  void end_run(double seconds);
  [[nodiscard]] double curvature_to(const Pose2& T_odom_steered) const;

  DrivingParams params_;
  SteeredPoint steered_;
  PoseFilter filter_;
  PoseTrust trust_;
  HeardVehicle vehicle_;
  HoldLimit hold_limit_;
  UnmeasuredWay unmeasured_;
  WheelDisagreement wheels_;
  MissionLeave leave_;
  CommandRamp ramp_;
  DrivingState state_;
  std::optional<PathProgress> progress_;
  std::optional<SpeedProfile> profile_;  ///< of the run
  std::optional<std::int64_t> utime_;    ///< of the last command
  std::optional<std::string> held_;      ///< why the vehicle stands whatever it is told
  double wanted_1_m_ = 0.0;              ///< curvature, of the steered point
};

}  // namespace adit
