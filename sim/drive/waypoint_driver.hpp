// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"
#include "common/types/vehicle_state.hpp"
#include "sim/drive/drive_plan.hpp"
#include "sim/drive/waypoint_file.hpp"
#include "sim/vehicle/vehicle_model.hpp"

namespace adit {

struct WaypointDriverParams {
  double speed_m_s = 0.4;    ///< of waypoints without a speed
  double lookahead_m = 1.5;  ///< distance along the path to the point that the driver steers for
  bool reverse = false;     ///< drive in reverse to waypoints behind the vehicle instead of turning
  double slow_share = 0.4;  ///< factor on the speed in bends of 90° or more
  double braking_m_s2 = 0.15;        ///< planned deceleration before bends and the end
  double arrival_m = 0.05;           ///< remaining path length that counts as arrived
  double off_path_max_m = 2.0;       ///< cross-track error at which the driver aborts
  double progress_timeout_s = 20.0;  ///< time without progress after which the driver aborts
  double progress_min_m = 0.1;       ///< progress required within progress_timeout_s

  template <class V>
  void visit(V& v) {
    v("speed_m_s", speed_m_s, above(0.0));
    v("lookahead_m", lookahead_m, above(0.0));
    v("reverse", reverse);
    v("slow_share", slow_share, within(0.05, 1.0));
    v("braking_m_s2", braking_m_s2, above(0.0));
    v("arrival_m", arrival_m, above(0.0));
    v("off_path_max_m", off_path_max_m, above(0.0));
    v("progress_timeout_s", progress_timeout_s, above(0.0));
    v("progress_min_m", progress_min_m, above(0.0));
  }
};

/// Follows waypoints by the true pose with pure pursuit (Coulter, "Implementation of the pure
/// pursuit path tracking algorithm", CMU-RI-TR-92-01). The path starts at the pose of the body at
/// the first command. At right angles the cross-track error reaches half of the look-ahead
/// distance, to the inside or the outside.
class WaypointDriver {
 public:
  /// Throws std::invalid_argument if there is no waypoint or one is not finite.
  WaypointDriver(std::vector<Waypoint> waypoints, const Vehicle& vehicle,
                 const WaypointDriverParams& params = {});

  /// Commands zero speed once the path is completed or aborted.
  DriveCommand command(const BodyMotion& motion);

  [[nodiscard]] double progress_m() const { return driven_m_ + s_m_; }
  [[nodiscard]] double length_m() const;  ///< of the path; 0 before the first command
  [[nodiscard]] bool done() const { return done_; }
  /// Why the driver aborted; empty if it did not.
  [[nodiscard]] const std::optional<std::string>& abort_reason() const { return abort_reason_; }

 private:
  void plan(const Pose2& T_world_body);
  void follow(const Pose2& T_world_body, std::int64_t utime);
  bool is_progressing(std::int64_t utime);
  void begin_next_run();
  [[nodiscard]] double curvature(const Pose2& T_world_body) const;
  [[nodiscard]] double speed() const;
  [[nodiscard]] double bend_rad(double s_m) const;

  std::vector<Waypoint> waypoints_;
  Vehicle vehicle_;
  WaypointDriverParams params_;
  std::vector<DriveLegs> runs_;
  std::size_t run_ = 0;
  double s_m_ = 0.0;              ///< distance along the current run
  double driven_m_ = 0.0;         ///< length of the completed runs
  double last_progress_m_ = 0.0;  ///< progress at last_progress_utime_
  std::int64_t last_progress_utime_ = 0;
  bool planned_ = false;
  bool done_ = false;
  std::optional<std::string> abort_reason_;
};

}  // namespace adit
