// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/own_track.hpp"

namespace adit {
namespace {

constexpr double kApartM = 0.2;       // of places; standing is no way
constexpr std::size_t kPlaces = 100;  // that are kept

}  // namespace

void OwnTrack::add(std::int64_t utime, const Pose2& T_odom_body) {
  utime_ = utime;
  T_odom_body_ = T_odom_body;
  if (places_.empty()) {
    places_.push_back(T_odom_body.translation());
    return;
  }
  const double way_m = (T_odom_body.translation() - places_.back()).norm();
  if (way_m < kApartM) return;
  travelled_m_ += way_m;
  places_.push_back(T_odom_body.translation());
  if (places_.size() > kPlaces) places_.pop_front();
}

void OwnTrack::begin_anew(const std::optional<Pose2>& T_map_odom) {
  T_odom_body_.reset();
  if (T_map_odom) {
    for (const auto& place : places_) before_map_.push_back(*T_map_odom * place);
  }
  places_.clear();
}

void OwnTrack::tie(const Pose2& T_map_odom) {
  const Pose2 T_odom_map = T_map_odom.inverse();
  for (; !before_map_.empty(); before_map_.pop_back()) {
    places_.push_front(T_odom_map * before_map_.back());
  }
}

std::vector<Eigen::Vector2d> OwnTrack::back(double length_m) const {
  if (!T_odom_body_) return {};
  std::vector<Eigen::Vector2d> way{T_odom_body_->translation()};
  double way_m = 0.0;
  for (auto place = places_.rbegin(); place != places_.rend() && way_m < length_m; ++place) {
    way_m += (*place - way.back()).norm();
    way.push_back(*place);
  }
  return way;
}

}  // namespace adit
