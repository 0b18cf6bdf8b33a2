// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/mission.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/vehicle.hpp"
#include "common/types/vehicle_state.hpp"
#include "procs/driving/controllers.hpp"
#include "procs/driving/motion_permission.hpp"
#include "procs/driving/path_run.hpp"
#include "procs/driving/pose_filter.hpp"
#include "procs/driving/progress_monitor.hpp"
#include "procs/driving/speed_control.hpp"

namespace adit {

struct SteeringParams {
  double rate_1_m_s = 0.4;  ///< greatest change of the curvature per second
  double blend_m = 0.5;     ///< way over which a jump of the path's curvature is steered

  template <class V>
  void visit(V& v) {
    v("rate_1_m_s", rate_1_m_s, above(0.0));
    v("blend_m", blend_m, within(0.0, 2.0));
  }
};

struct DrivingParams {
  Vehicle vehicle;
  std::string controller = "pd";  ///< or "pure_pursuit"
  LateralParams pd;
  PurePursuitParams pure_pursuit;
  SpeedParams speed;
  SteeringParams steering;
  LocalizationMonitorParams trust;
  double smoothing_s = 0.3;      ///< of poses; longer than their noise, shorter than their drift
  double reaction_s = 0.05;      ///< after which a command takes effect
  double arrival_m = 0.02;       ///< left of a run at its end
  double distance_max_m = 0.35;  ///< off the path; beyond, it needs a new one
  double heading_max_rad = 0.5;  ///< against the path, likewise
  double hold_timeout_s = 10.0;  ///< without way; held for longer, likewise
  double unobserved_distance_max_m = 5.0;  ///< driven without a sensor that tells how far, likewise
  double odometry_mismatch_max_m =
      0.2;  ///< way by the wheels beside that by the poses, since a path began
  double odometry_mismatch_max_share = 0.08;  ///< and so much of the way; beyond, likewise

  template <class V>
  void visit(V& v) {
    v.shared(Vehicle::kSection, vehicle);
    v("controller", controller, OneOf({"pd", "pure_pursuit"}));
    v("pd", pd);
    v("pure_pursuit", pure_pursuit);
    v("speed", speed);
    v("steering", steering);
    v("trust", trust);
    v("smoothing_s", smoothing_s, above_up_to(0.0, 5.0));
    v("reaction_s", reaction_s, within(0.0, 0.5));
    v("arrival_m", arrival_m, within(0.005, 0.5));
    v("distance_max_m", distance_max_m, above_up_to(0.0, 2.0));
    v("heading_max_rad", heading_max_rad, above_up_to(0.0, 1.2));
    v("hold_timeout_s", hold_timeout_s, within(1.0, 600.0));
    v("unobserved_distance_max_m", unobserved_distance_max_m, above(0.0));
    v("odometry_mismatch_max_m", odometry_mismatch_max_m, above(0.0));
    v("odometry_mismatch_max_share", odometry_mismatch_max_share, within(0.0, 10.0));
  }
};

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
  void update_permission(std::int64_t utime);
  [[nodiscard]] bool is_active() const;
  void begin_run();
  void update_progress(std::int64_t utime);
  void check_progress(std::int64_t utime, const Pose2& T_odom_steered);
  void fail(const std::string& reason);
  void move(double seconds);
  [[nodiscard]] double target_speed_m_s() const;
  void finish_run(double seconds);
  [[nodiscard]] double target_curvature_1_m(const Pose2& T_odom_steered) const;

  DrivingParams params_;
  SteeredPoint steered_;
  PoseFilter filter_;
  LocalizationMonitor localization_;
  VehicleFeedback vehicle_;
  HoldTimeout hold_timeout_;
  UnobservedMotion unobserved_;
  OdometryMismatch odometry_mismatch_;
  MotionPermission permission_;
  CommandRamp ramp_;
  DrivingState state_;
  std::optional<PathProgress> progress_;
  std::optional<SpeedProfile> profile_;     ///< of the run
  std::optional<std::int64_t> utime_;       ///< of the last command
  std::optional<std::string> hold_reason_;  ///< why the vehicle stands whatever it is told
  double target_curvature_1_m_ = 0.0;       ///< curvature, of the steered point
};

}  // namespace adit
