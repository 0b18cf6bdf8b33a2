// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/driven_path.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kStepM = 0.1;
constexpr double kStepRad = 0.1;
constexpr double kJumpM = 0.5;    // beyond what the body can drive in the time
constexpr double kJumpRad = 0.7;  // within a second
constexpr std::size_t kPlaces = 20'000;
constexpr double kJoinedM = 1.0;  // between successive places; a longer gap is no driven ground
constexpr double kMeetingM = 0.3;
constexpr double kLoopMinM = 1.0;    // driven between two places that meet
constexpr double kPlacedSdM = 0.05;  // of two places relative to each other, half a terrain cell

}  // namespace

bool DrivenPath::can_follow(std::int64_t utime, const Pose2& T_odom_body) const {
  if (!last_) return true;
  const double since_s = seconds(std::max<std::int64_t>(utime - last_->utime, 0));
  const Pose2 step = between(last_->T_odom_body, T_odom_body);
  if (step.translation().norm() > kJumpM + 2.0 * limits_.speed_max_m_s * since_s) return false;
  return since_s > 1.0 || std::abs(step.theta) < kJumpRad;
}

bool DrivenPath::add(std::int64_t utime, const Pose2& T_odom_body) {
  const bool follows = can_follow(utime, T_odom_body);
  last_ = {utime, T_odom_body};
  if (!follows) previous_ = std::exchange(places_, {});
  if (!places_.empty()) {
    const Pose2 step = between(places_.back().T_odom_body, T_odom_body);
    const double step_length_m = step.translation().norm();
    if (step_length_m < kStepM && std::abs(step.theta) < kStepRad) return follows;
    distance_travelled_m_ += step_length_m;
  }
  places_.push_back({T_odom_body, distance_travelled_m_, utime, position_variance_});
  while (places_.size() > kPlaces || has_expired(places_.front().distance_travelled_m))
    places_.pop_front();
  find_meeting();
  return follows;
}

/// Relates the newest place to the oldest one that it meets.
void DrivenPath::find_meeting() {
  Place& newest = places_.back();
  const auto near = [&](const Place& place) {
    return place.distance_travelled_m < newest.distance_travelled_m - kLoopMinM &&
           between(place.T_odom_body, newest.T_odom_body).translation().norm() < kMeetingM;
  };
  if (std::ranges::none_of(places_, near)) return;
  const std::vector<double> lengths_m = lengths_to_newest();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (std::isinf(lengths_m[i]) || !near(places_[i])) continue;
    newest.met_at_m = places_[i].distance_travelled_m;
    return;
  }
}

/// Poses of the new odom frame may have arrived before the report of it.
bool DrivenPath::reset(std::int64_t odom_epoch_utime) {
  const auto end = std::ranges::find_if(
      places_, [&](const Place& place) { return place.utime >= odom_epoch_utime; });
  if (end == places_.begin()) return false;
  previous_.assign(places_.begin(), end);
  places_.erase(places_.begin(), end);
  if (last_ && last_->utime < odom_epoch_utime) last_.reset();
  return true;
}

void DrivenPath::anchor(const Pose2& T_odom_previous) {
  for (auto place = previous_.rbegin(); place != previous_.rend(); ++place) {
    Place anchored = *place;
    anchored.T_odom_body = T_odom_previous * place->T_odom_body;
    places_.push_front(anchored);
  }
  previous_.clear();
}

void DrivenPath::correct(const Pose2& T_after_before, double position_variance) {
  corrected_at_m_ = distance_travelled_m_;
  position_variance_ = position_variance;
  for (Place& place : places_) {
    if (!keeps_place_in_map(place.distance_travelled_m)) return;
    place.T_odom_body = T_after_before * place.T_odom_body;
  }
}

bool DrivenPath::keeps_place_in_map(double distance_travelled_m) const {
  return distance_travelled_m < distance_travelled_m_ - kKeepsPlaceInOdomM;
}

/// The variance between two places is what it has grown by between them: where scans match what was
/// mapped before it does not grow, and between smooth walls it does. Where a loop closure has made
/// it smaller, map has moved as well, and an old place may not have moved with it.
bool DrivenPath::is_well_placed(const Place& place) const {
  if (place.distance_travelled_m >= distance_travelled_m_ - limits_.distance_max_m) return true;
  return std::abs(position_variance_ - place.position_variance) <= kPlacedSdM * kPlacedSdM;
}

bool DrivenPath::has_expired(double distance_travelled_m) const {
  return std::max(distance_travelled_m, corrected_at_m_) <
         distance_travelled_m_ - limits_.distance_max_m;
}

/// The first place at this distance; the number of places if it is forgotten.
std::size_t DrivenPath::index_of(double distance_travelled_m) const {
  const auto found =
      std::ranges::lower_bound(places_, distance_travelled_m, {}, &Place::distance_travelled_m);
  if (found == places_.end() || found->distance_travelled_m > distance_travelled_m) {
    return places_.size();
  }
  return static_cast<std::size_t>(found - places_.begin());
}

/// For each place, by Dijkstra's search [m]; infinite beyond `path_length_max_m`, and where there
/// is no driven ground in between.
std::vector<double> DrivenPath::lengths_to_newest() const {
  std::vector<double> lengths_m(places_.size(), std::numeric_limits<double>::infinity());
  if (places_.empty()) return lengths_m;
  std::vector<std::vector<std::size_t>> meetings(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!places_[i].met_at_m) continue;
    const std::size_t met = index_of(*places_[i].met_at_m);
    if (met == places_.size()) continue;
    meetings[i].push_back(met);
    meetings[met].push_back(i);
  }
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](std::size_t from, std::size_t to) {
    const double step_m =
        between(places_[from].T_odom_body, places_[to].T_odom_body).translation().norm();
    const double length_m = lengths_m[from] + step_m;
    if (length_m >= lengths_m[to] || length_m > limits_.path_length_max_m) return;
    lengths_m[to] = length_m;
    open.emplace(length_m, to);
  };
  const auto joined = [&](std::size_t i, std::size_t next) {
    return places_[next].distance_travelled_m - places_[i].distance_travelled_m <= kJoinedM;
  };
  lengths_m.back() = 0.0;
  open.emplace(0.0, places_.size() - 1);
  while (!open.empty()) {
    const auto [length_m, i] = open.top();
    open.pop();
    if (length_m > lengths_m[i]) continue;
    if (i > 0 && joined(i - 1, i)) reach(i, i - 1);
    if (i + 1 < places_.size() && joined(i, i + 1)) reach(i, i + 1);
    for (const std::size_t met : meetings[i]) reach(i, met);
  }
  return lengths_m;
}

std::vector<DrivenPath::Place> DrivenPath::same_level() const {
  const std::vector<double> lengths_m = lengths_to_newest();
  std::vector<Place> places;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (std::isfinite(lengths_m[i]) && is_well_placed(places_[i])) places.push_back(places_[i]);
  }
  return places;
}

}  // namespace adit
