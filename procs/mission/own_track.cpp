// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/own_track.hpp"

#include <algorithm>
#include <cmath>

#include "common/path/planned_path.hpp"

namespace adit {
namespace {

constexpr double kApartM = 0.2;  // of places; standing is no way
constexpr double kApartRad = 0.1;
// Of poses that are the same: half-way to the next place along them, and beside them as far as a
// path is followed.
constexpr double kSameAlongM = 0.15;
constexpr double kSameBesideM = 0.1;
constexpr double kSameRad = 0.1;
constexpr double kBesideM = 1.0;  // of a route that keeps to the track
constexpr double kLongerM = 2.0;  // that the track may take than the route, from place to place

bool is_same(const Pose2& T_odom_a, const Pose2& T_odom_b) {
  const Pose2 T_a_b = between(T_odom_a, T_odom_b);
  return std::abs(T_a_b.x) < kSameAlongM && std::abs(T_a_b.y) < kSameBesideM &&
         std::abs(T_a_b.theta) < kSameRad;
}

}  // namespace

bool OwnTrack::add(std::int64_t utime, const Pose2& T_odom_body) {
  utime_ = utime;
  T_odom_body_ = T_odom_body;
  if (!places_.empty()) {
    const Pose2 step = between(places_.back(), T_odom_body);
    const double way_m = step.translation().norm();
    if (way_m < kApartM && std::abs(step.theta) < kApartRad) return false;
    travelled_m_ += way_m;
  }
  const auto before = std::find_if(places_.begin(), places_.end(), [&](const Pose2& T_odom_place) {
    return is_same(T_odom_place, T_odom_body);
  });
  places_.erase(before, places_.end());
  places_.push_back(T_odom_body);
  return true;
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
  std::vector<Pose2> before;
  for (const Pose2& T_map_place : before_map_) before.push_back(T_odom_map * T_map_place);
  places_.insert(places_.begin(), before.begin(), before.end());
  before_map_.clear();
}

std::vector<Pose2> OwnTrack::back(double length_m) const {
  if (!T_odom_body_) return {};
  std::vector<Pose2> way{*T_odom_body_};
  double way_m = 0.0;
  for (auto place = places_.rbegin(); place != places_.rend() && way_m < length_m; ++place) {
    way_m += (place->translation() - way.back().translation()).norm();
    way.push_back(*place);
  }
  return way;
}

double OwnTrack::back_m(double length_m) const {
  const std::vector<Pose2> way = back(length_m);
  double way_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    way_m += (way[i].translation() - way[i - 1].translation()).norm();
  }
  return way_m;
}

std::vector<Pose2> OwnTrack::back_within(double distance_m) const {
  if (!T_odom_body_) return {};
  std::vector<Pose2> way{*T_odom_body_};
  const Eigen::Vector2d p_body = T_odom_body_->translation();
  for (auto place = places_.rbegin(); place != places_.rend(); ++place) {
    if (way.size() == PlanGoal::kPlacesMax) break;
    if ((place->translation() - p_body).norm() <= distance_m) way.push_back(*place);
  }
  return way;
}

double OwnTrack::shared_m(const std::vector<Eigen::Vector2d>& route_odom) const {
  double shared_m = 0.0;
  auto nearest = places_.rbegin();
  for (std::size_t i = 1; i < route_odom.size() && nearest != places_.rend(); ++i) {
    const auto off_m = [&](const Pose2& place) {
      return (place.translation() - route_odom[i]).norm();
    };
    const double leg_m = (route_odom[i] - route_odom[i - 1]).norm();
    const auto ahead = static_cast<std::ptrdiff_t>((leg_m + kLongerM) / kApartM);
    const auto end = nearest + std::min(ahead, places_.rend() - nearest);
    nearest = std::min_element(nearest, end,
                               [&](const Pose2& a, const Pose2& b) { return off_m(a) < off_m(b); });
    if (off_m(*nearest) > kBesideM) break;
    shared_m += leg_m;
  }
  return shared_m;
}

}  // namespace adit
