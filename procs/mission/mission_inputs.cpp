// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What the mission hears unasked: motion, the map, people.

#include <optional>
#include <utility>

#include "common/pose_graph/map_correction.hpp"
#include "procs/mission/mission.hpp"

namespace adit {

std::optional<StoredPathPose> Mission::add_pose(std::int64_t utime, const Pose2& T_odom_body) {
  if (!traversed_path_.add(utime, T_odom_body) || odom_epoch_utime_ == 0) return std::nullopt;
  return StoredPathPose{odom_epoch_utime_, T_odom_body, T_map_odom_, traversed_path_.is_anchored()};
}

/// Poses may have come since the restart. They may be of a new odom frame, in which what was driven
/// before is only known once it is tied.
void Mission::restore_path() {
  if (restored_path_.empty()) return;
  TraversedPath track = traversed_path_from(restored_path_);
  const StoredPathPose last = restored_path_.back();
  restored_path_.clear();
  track.set_distance_travelled(traversed_path_.distance_travelled_m());
  if (last.odom_epoch_utime != odom_epoch_utime_) {
    track.reset(last.T_map_odom);
  } else if (!T_map_odom_) {
    T_map_odom_ = last.T_map_odom;
  }
  if (traversed_path_.T_odom_body())
    track.add(traversed_path_.utime(), *traversed_path_.T_odom_body());
  traversed_path_ = std::move(track);
}

/// Where scan matching begins anew, so does odom, and what was planned in it is of no use.
void Mission::add_match(const ScanMatch& match) {
  const bool drives = driving_ && driving_->kind == DrivingState::Kind::kDriving;
  limits_.add(match, moves() && drives);
  if (match.odom_epoch_utime == odom_epoch_utime_) return;
  const bool is_first = odom_epoch_utime_ == 0;
  odom_epoch_utime_ = match.odom_epoch_utime;
  if (is_first) restore_path();
  if (is_first && match.odom_epoch_utime <= restored_utime_) return;
  if (is_first && !restored_) return;
  odom_is_new_ = true;
  has_map_ = false;
  const auto T_map_before = std::exchange(T_map_odom_, std::nullopt);
  if (!is_first) traversed_path_.reset(T_map_before);
  rejected_ = {};
  path_ends_ = {};
  p_odom_home_.reset();
  path_back_failed_ = false;
  rejoin_count_ = 0;
  if (phase_.phase == Phase::kPaused || phase_.phase == Phase::kEnded) return;
  if (is_first && !return_is_final_ && params_.after_power_loss == "home") {
    return_is_final_ = phase_.returning_home = true;
    phase_.return_home_reason = "the computer was off";
  }
  enter(Phase::kWaiting, "odom begins anew: it waits to know where it is on its map");
}

void Mission::add_correction(const MapCorrection& correction) {
  limits_.add(correction);
  if (correction.utime < odom_epoch_utime_) return;  // of the odom frame before
  has_map_ = true;
  T_map_odom_ = correction.T_map_odom;
  if (odom_is_localized(correction)) traversed_path_.anchor(correction.T_map_odom);
}

void Mission::add_order(const MissionOrder& order) {
  using Order = MissionOrder::Kind;
  if (phase_.phase == Phase::kEnded) return;
  const bool paused = phase_.phase == Phase::kPaused;
  if (order.kind == Order::kPause && !paused) {
    enter(Phase::kPaused, "by order");
  } else if (order.kind == Order::kResume && paused) {
    enter(Phase::kWaiting, "by order it goes on");
  } else if (order.kind == Order::kReturnHome && !return_is_final_) {
    turn_around("by order");
  } else if (order.kind == Order::kStop) {
    end(MissionOutcome::kStopped, "by order");
  }
}

}  // namespace adit
