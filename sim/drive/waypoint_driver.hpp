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
  double speed_m_s = 0.4;       ///< where a waypoint says nothing else
  double lookahead_m = 1.5;     ///< along the way, of the point that is steered for
  bool reverse = false;         ///< back up to waypoints that lie behind, instead of turning round
  double slow_share = 0.4;      ///< of the speed, through a bend of a right angle or more
  double braking_m_s2 = 0.15;   ///< planned before bends and the end
  double arrival_m = 0.05;      ///< left of the way at its end
  double off_path_max_m = 2.0;  ///< gives up beyond
  double progress_timeout_s = 20.0;  ///< gives up after, without progress
  double progress_min_m = 0.1;       ///< in that time

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

/// Drives along waypoints by the truth, as a person who sees the mine would: pure pursuit (Coulter,
/// "Implementation of the pure pursuit path tracking algorithm", CMU-RI-TR-92-01). The way begins
/// where the body is at the first command. Right angles are missed by up to half of the look-ahead,
/// to the inside or the outside.
class WaypointDriver {
 public:
  /// Throws std::invalid_argument without waypoints, or with one that is not finite.
  WaypointDriver(std::vector<Waypoint> waypoints, const Vehicle& vehicle,
                 const WaypointDriverParams& params = {});

  /// To stand, once the way is done or given up.
  DriveCommand command(const BodyMotion& motion);

  [[nodiscard]] double progress_m() const { return driven_m_ + s_m_; }
  [[nodiscard]] double length_m() const;  ///< of the way; 0 before the first command
  [[nodiscard]] bool done() const { return done_; }
  /// Why the driver gave up; nothing while it did not.
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
  double s_m_ = 0.0;              ///< along the run
  double driven_m_ = 0.0;         ///< of the runs before
  double last_progress_m_ = 0.0;  ///< when there was progress last
  std::int64_t last_progress_utime_ = 0;
  bool planned_ = false;
  bool done_ = false;
  std::optional<std::string> abort_reason_;
};

}  // namespace adit
