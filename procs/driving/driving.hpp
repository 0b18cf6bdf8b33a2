// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/path/driving_state.hpp"
#include "common/path/planned_path.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/vehicle/drive_command.hpp"
#include "common/vehicle/vehicle.hpp"
#include "procs/driving/lateral_control.hpp"
#include "procs/driving/path_progress.hpp"
#include "procs/driving/pose_filter.hpp"
#include "procs/driving/pose_trust.hpp"
#include "procs/driving/pure_pursuit.hpp"
#include "procs/driving/speed_profile.hpp"
#include "procs/driving/steered_point.hpp"

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
  PursuitParams pure_pursuit;
  SpeedParams speed;
  SteeringParams steering;
  TrustParams trust;
  double smoothing_s = 0.3;      ///< of poses; longer than their noise, shorter than their drift
  double reaction_s = 0.05;      ///< after which a command takes effect
  double arrival_m = 0.02;       ///< left of a run at its end
  double distance_max_m = 0.35;  ///< off the path; beyond, it needs a new one
  double heading_max_rad = 0.5;  ///< against the path, likewise

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
  }
};

/// What driving says at a time.
struct DriveOutput {
  DriveCommand command;
  DrivingState state;
};

/// Drives along paths: where the robot is on its path, how far beside it, how it must be steered
/// and how fast it may go (the paper's section 3.3). It stands while it does not know where it is
/// and goes on when it does; beside its path it stands until it gets a new one.
class Driving {
 public:
  /// Throws std::invalid_argument for a vehicle that cannot be steered.
  explicit Driving(const DrivingParams& params);

  /// Takes the place of the path before. Where none was found, or one of more than a kilometre,
  /// there is none to drive.
  void follow(const PlannedPath& path);
  void add_pose(std::int64_t utime, const Pose2& T_odom_body);
  void add_match(std::int64_t utime, ScanMatch::Status status);

  /// The command for now; to be asked at least each 200 ms while it drives.
  DriveOutput drive(std::int64_t utime);

  [[nodiscard]] const DrivingState& state() const { return state_; }

 private:
  using Kind = DrivingState::Kind;

  double seconds_to(std::int64_t utime);
  void trust_or_wait(std::int64_t utime);
  void begin_run();
  void locate(std::int64_t utime);
  void fail(const std::string& reason);
  void move(double seconds);
  void end_run(double seconds);
  void steer(double seconds);
  void accelerate(double seconds);
  void stand(double seconds);
  [[nodiscard]] double curvature_to(const Pose2& T_odom_steered) const;

  DrivingParams params_;
  SteeredPoint steered_;
  PoseFilter filter_;
  PoseTrust trust_;
  DrivingState state_;
  std::optional<PathProgress> progress_;
  std::optional<SpeedProfile> profile_;  ///< of the run
  std::optional<std::int64_t> utime_;    ///< of the last command
  double speed_m_s_ = 0.0;               ///< of it, signed
  double curvature_1_m_ = 0.0;           ///< of it, of the steered point
  double wanted_1_m_ = 0.0;              ///< what the curvature is to become
  double standing_s_ = 0.0;              ///< for which it has been told to stand
};

}  // namespace adit
