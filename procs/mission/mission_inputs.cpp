// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What the mission hears unasked: motion, the map, people.

#include <optional>
#include <utility>

#include "common/pose_graph/position_sd.hpp"
#include "procs/mission/mission.hpp"

namespace adit {

std::optional<KeptPlace> Mission::add_pose(std::int64_t utime, const Pose2& T_odom_body) {
  if (!way_.add(utime, T_odom_body) || odom_utime_ == 0) return std::nullopt;
  return KeptPlace{odom_utime_, T_odom_body, T_map_odom_, way_.is_tied()};
}

/// Poses may have come since the restart. They may be of a new odom frame, in which what was driven
/// before is only known once it is tied.
void Mission::take_up_track() {
  if (restored_track_.empty()) return;
  OwnTrack track = track_of(restored_track_);
  const KeptPlace last = restored_track_.back();
  restored_track_.clear();
  track.set_travelled(way_.travelled_m());
  if (last.odom_utime != odom_utime_) {
    track.begin_anew(last.T_map_odom);
  } else if (!T_map_odom_) {
    T_map_odom_ = last.T_map_odom;
  }
  if (way_.T_odom_body()) track.add(way_.utime(), *way_.T_odom_body());
  way_ = std::move(track);
}

/// Where scan matching begins anew, so does odom, and what was planned in it is of no use.
void Mission::add_match(const ScanMatch& match) {
  const bool drives = driving_ && driving_->kind == DrivingState::Kind::kDriving;
  limits_.add(match, moves() && drives);
  if (match.odom_utime == odom_utime_) return;
  const bool first_heard = odom_utime_ == 0;
  odom_utime_ = match.odom_utime;
  if (first_heard) take_up_track();
  if (first_heard && match.odom_utime <= restored_utime_) return;
  if (first_heard && !restored_) return;
  odom_is_new_ = true;
  has_map_ = false;
  const auto T_map_before = std::exchange(T_map_odom_, std::nullopt);
  if (!first_heard) way_.begin_anew(T_map_before);
  refused_ = {};
  path_ends_ = {};
  p_odom_home_.reset();
  track_failed_ = false;
  rejoined_ = 0;
  if (phase_.phase == Phase::kPaused || phase_.phase == Phase::kEnded) return;
  if (first_heard && !home_for_good_ && params_.after_cut_off == "home") {
    home_for_good_ = phase_.homeward = true;
    phase_.homeward_reason = "the computer was off";
  }
  enter(Phase::kWaiting, "odom begins anew: it waits to know where it is on its map");
}

void Mission::add_correction(const MapCorrection& correction) {
  limits_.add(correction);
  if (correction.utime < odom_utime_) return;  // of the odom frame before
  has_map_ = true;
  T_map_odom_ = correction.T_map_odom;
  if (says_where_odom_is(correction)) way_.tie(correction.T_map_odom);
}

void Mission::add_order(const MissionOrder& order) {
  using Order = MissionOrder::Kind;
  if (phase_.phase == Phase::kEnded) return;
  const bool paused = phase_.phase == Phase::kPaused;
  if (order.kind == Order::kPause && !paused) {
    enter(Phase::kPaused, "by order");
  } else if (order.kind == Order::kGoOn && paused) {
    enter(Phase::kWaiting, "by order it goes on");
  } else if (order.kind == Order::kComeHome && !home_for_good_) {
    turn_around("by order");
  } else if (order.kind == Order::kStop) {
    end(MissionOutcome::kStopped, "by order");
  }
}

}  // namespace adit
