// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission_localization.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kPoseTimeoutS = 1.0;
constexpr double kSds95 = 2.448;  // of a Gaussian in the plane: sqrt(-2 ln 0.05)

}  // namespace

void MissionLocalization::restore(std::int64_t last_utime, double distance_travelled_m,
                                  std::vector<StoredPathPose> path, KnownMap known_map) {
  known_map_ = std::move(known_map);
  restored_utime_ = last_utime;
  restored_path_ = std::move(path);
  traversed_path_.set_distance_travelled(distance_travelled_m);
}

std::optional<StoredPathPose> MissionLocalization::add_pose(std::int64_t utime,
                                                            const Pose2& T_odom_body,
                                                            double z_odom_m) {
  if (!traversed_path_.add(utime, T_odom_body, z_odom_m) || !odom_epoch_utime_) return std::nullopt;
  return StoredPathPose{*odom_epoch_utime_, T_odom_body,
                        T_map_odom_,        traversed_path_.is_anchored(),
                        z_odom_m,           z_map_odom_m_};
}

MissionLocalization::OdomChange MissionLocalization::set_odom_epoch(std::int64_t odom_epoch_utime) {
  if (odom_epoch_utime == odom_epoch_utime_) return OdomChange::kNone;
  const bool is_first = !odom_epoch_utime_;
  odom_epoch_utime_ = odom_epoch_utime;
  if (is_first) {
    restore_path();
    if (!restored_utime_ || odom_epoch_utime <= *restored_utime_) return OdomChange::kNone;
  }
  odom_was_reset_ = true;
  has_correction_ = false;
  const auto T_map_before = std::exchange(T_map_odom_, std::nullopt);
  if (is_first) {
    map_is_restored_ = true;
    return OdomChange::kResetBeforeRestart;
  }
  traversed_path_.reset(T_map_before, z_map_odom_m_);
  return OdomChange::kReset;
}

/// Poses may have arrived since the restart. If they belong to a new odom frame, the restored path
/// is usable in it only once it is anchored.
void MissionLocalization::restore_path() {
  if (restored_path_.empty()) return;
  TraversedPath path = traversed_path_from(restored_path_);
  const StoredPathPose last = restored_path_.back();
  restored_path_.clear();
  path.set_distance_travelled(traversed_path_.distance_travelled_m());
  if (last.odom_epoch_utime != odom_epoch_utime_) {
    path.reset(last.T_map_odom, last.z_map_odom_m);
  } else if (!T_map_odom_) {
    T_map_odom_ = last.T_map_odom;
    z_map_odom_m_ = last.z_map_odom_m;
  }
  if (traversed_path_.T_odom_body())
    path.add(traversed_path_.utime(), *traversed_path_.T_odom_body(), traversed_path_.z_odom_m());
  traversed_path_ = std::move(path);
}

double MissionLocalization::add_correction(const MapCorrection& correction) {
  if (correction.utime < odom_epoch_utime_) return 0.0;  // of the odom frame before
  compare_map(correction);
  has_correction_ = true;
  double moved_at_body_m = 0.0;
  if (T_map_odom_ && *T_map_odom_ != correction.T_map_odom) {
    const Pose2 T_after_before = between(correction.T_map_odom, *T_map_odom_);
    traversed_path_.correct(T_after_before, z_map_odom_m_ - correction.z_map_odom_m);
    if (T_odom_body()) moved_at_body_m = moved_at_m(T_after_before, T_odom_body()->translation());
  }
  T_map_odom_ = correction.T_map_odom;
  z_map_odom_m_ = correction.z_map_odom_m;
  body_sd_m_ = position_sd_m(correction.body_covariance);
  if (odom_is_localized(correction)) traversed_path_.anchor(correction.T_map_odom, z_map_odom_m_);
  return moved_at_body_m;
}

/// The first local map after a restart has a greater id than all that the mission knew before,
/// unless the map has lost some of them, or all: then the body is not at its end.
void MissionLocalization::compare_map(const MapCorrection& correction) {
  const int newest = known_map_.newest_local_map.value_or(-1);
  if (std::exchange(map_is_restored_, false) && correction.local_map <= newest) {
    known_map_.home_unknown = fmt::format(
        "the map has lost local maps {} to {}, which the robot had before the computer was off",
        correction.local_map, newest);
  }
  known_map_.newest_local_map = std::max(newest, correction.local_map);
}

std::optional<double> MissionLocalization::home_uncertainty_m() const {
  return has_correction_ ? std::optional(kSds95 * body_sd_m_) : std::nullopt;
}

/// Home is the origin of map.
std::optional<double> MissionLocalization::distance_from_home_m() const {
  if (!has_correction_ || !T_odom_body()) return std::nullopt;
  const double z_m = z_map_odom_m_ + traversed_path_.z_odom_m();
  return std::hypot((*T_map_odom_ * *T_odom_body()).translation().norm(), z_m);
}

void MissionLocalization::anchor_to_estimate() {
  if (!traversed_path_.is_anchored() && T_map_odom_)
    traversed_path_.anchor(*T_map_odom_, z_map_odom_m_);
}

bool MissionLocalization::has_recent_pose(std::int64_t utime) const {
  return T_odom_body() && seconds(utime - traversed_path_.utime()) < kPoseTimeoutS;
}

}  // namespace adit
