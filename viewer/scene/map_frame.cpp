// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/map_frame.hpp"

#include <cstddef>

namespace adit {

void MapFrame::set_correction(const MapCorrection& correction) {
  correction_ = correction;
  T_map_odom_ = {correction.T_map_odom, correction.z_map_odom_m};
}

void MapFrame::add_local_map(const LocalMap& map) {
  if (newest_ && map.id < newest_->id) return;  // sent again
  newest_ = {map.id, map.session, {map.T_odom_local, map.z_odom_m}};
}

std::optional<LevelPose> MapFrame::T_map_local(int id) const {
  const auto index = static_cast<std::size_t>(id);
  if (id < 0 || index >= graph_.poses.size()) return std::nullopt;
  return LevelPose{graph_.poses[index], index < graph_.z_m.size() ? graph_.z_m[index] : 0.0};
}

/// The newest local map of the session to which odom belongs is the anchor. A session whose first
/// local map has not arrived has none.
AnchoredPose MapFrame::anchored(const LevelPose& T_odom_x) const {
  const bool has_anchor = newest_ && T_map_local(newest_->id) &&
                          (!correction_ || correction_->session == newest_->session);
  if (!has_anchor) return {AnchoredPose::kNone, T_map_odom_ * T_odom_x};
  return {newest_->id, between(newest_->T_odom_local, T_odom_x)};
}

LevelPose MapFrame::T_map(const AnchoredPose& pose) const {
  const auto T_map_anchor = T_map_local(pose.local_map);
  return T_map_anchor ? *T_map_anchor * pose.T_anchor : pose.T_anchor;
}

}  // namespace adit
