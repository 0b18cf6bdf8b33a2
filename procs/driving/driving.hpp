// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/geometry/attitude.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/mission.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/vehicle.hpp"
#include "common/types/vehicle_state.hpp"
#include "procs/driving/controllers.hpp"
#include "procs/driving/drift_angle.hpp"
#include "procs/driving/hold_steering.hpp"
#include "procs/driving/motion_permission.hpp"
#include "procs/driving/passage_centring.hpp"
#include "procs/driving/path_run.hpp"
#include "procs/driving/pose_filter.hpp"
#include "procs/driving/progress_monitor.hpp"
#include "procs/driving/speed_control.hpp"

namespace adit {

struct SteeringParams {
  double rate_1_m_s = 0.5;  ///< maximum rate of change of the curvature, of the vehicle
  double blend_m = 0.5;     ///< distance over which a jump of the path's curvature is blended
  /// The same where walls are far enough that the speed is not reduced for them.
  double blend_wide_m = 0.6;

  template <class V>
  void visit(V& v) {
    v("rate_1_m_s", rate_1_m_s, above(0.0));
    v("blend_m", blend_m, within(0.0, 2.0));
    v("blend_wide_m", blend_wide_m, within(0.0, 2.0));
  }
};

struct DrivingParams {
  Lasers lasers;
  Vehicle vehicle;
  std::string controller = "pd";  ///< or "pure_pursuit"
  LateralParams pd;
  PurePursuitParams pure_pursuit;
  PassageCentringParams centring;  ///< with the controller pd
  SpeedParams speed;
  SteeringParams steering;
  LocalizationMonitorParams localization;
  ProgressLimits progress;
  double smoothing_s = 0.3;  ///< of poses; longer than their noise, shorter than their drift
  double reaction_s = 0.05;  ///< delay after which a command takes effect
  double arrival_m = 0.02;   ///< remaining distance at which the end of a run is reached

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v.shared(Vehicle::kSection, vehicle);
    v("controller", controller, OneOf({"pd", "pure_pursuit"}));
    v("pd", pd);
    v("pure_pursuit", pure_pursuit);
    v("centring", centring);
    v("speed", speed);
    v("steering", steering);
    v("localization", localization);
    v("progress", progress);
    v("smoothing_s", smoothing_s, above_up_to(0.0, 5.0));
    v("reaction_s", reaction_s, within(0.0, 0.5));
    v("arrival_m", arrival_m, within(0.005, 0.5));
  }
};

/// The output of a control cycle.
struct DriveOutput {
  DriveCommand command;
  DrivingState state;
};

/// Follows paths (section 3.3 of the paper): locates the robot on its path, steers against the
/// lateral error, in narrow passages against that from their middle (PassageCentring), and limits
/// the speed. The robot stops while it may not move (MotionPermission) and resumes by itself. While
/// the vehicle is held, driving continues to command creeping, so that the guard can evaluate that
/// motion. If the robot makes no progress (ProgressMonitor), it stops until it gets a new path.
class Driving {
 public:
  /// Throws std::invalid_argument for a vehicle that cannot be steered.
  explicit Driving(const DrivingParams& params);

  /// Replaces the path. Idle if the planner found none, or one longer than 1 km.
  void follow(const PlannedPath& path);
  void add_pose(std::int64_t utime, const Pose2& T_odom_body, const Attitude& attitude = {});
  void add_match(const ScanMatch& match);
  /// Scans of a tilted laser are not used.
  void add_scan(LaserId laser, const LaserScan& scan);
  void add_tilt(LaserId laser, const TiltReading& reading);
  void add_state(const VehicleState& state);
  /// `utime` is the bus time of the reception.
  void add_phase(const MissionPhase& phase, std::int64_t utime);

  /// The command of this cycle. Must be called at least every 200 ms.
  DriveOutput drive(std::int64_t utime);

  [[nodiscard]] const DrivingState& state() const { return state_; }

 private:
  using Kind = DrivingState::Kind;

  double seconds_to(std::int64_t utime);
  void update_permission(std::int64_t utime);
  [[nodiscard]] bool is_active() const;
  void begin_run();
  void update_progress(std::int64_t utime);
  void move(double seconds);
  [[nodiscard]] double target_speed_m_s() const;
  void finish_run(double seconds);
  [[nodiscard]] double target_curvature_1_m(const Pose2& T_odom_steered) const;
  [[nodiscard]] PathTrackingError error_from_middle() const;

  DrivingParams params_;
  SteeredPoint steered_;
  PoseFilter filter_;
  DriftAngle drift_;
  HoldSteering hold_steering_;
  MotionPermission permission_;
  ProgressMonitor monitor_;
  CommandRamp ramp_;
  DrivingState state_;
  std::optional<PathProgress> progress_;
  std::optional<SpeedProfile> profile_;  ///< of the current run
  PassageCentring centring_;             ///< of the current run
  Attitude attitude_;
  std::array<double, 2> tilt_rad_{};   ///< by LaserId
  std::optional<std::int64_t> utime_;  ///< of the last command
  double target_curvature_1_m_ = 0.0;  ///< of the path of the steered point
};

}  // namespace adit
