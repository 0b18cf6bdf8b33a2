// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/retracing.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr double kBackOffMinM = 1.0;    // of traversed path behind the robot
constexpr double kLeadsBackMinM = 0.1;  // less is no path back
constexpr double kSharedMinM = 2.5;     // of the route with the traversed path
constexpr double kRejoinM = 6.0;        // at first
constexpr double kRejoinMaxM = 30.0;    // after several rejoins
constexpr double kRejoinViewM = 10.0;   // poses beyond the rejoin length that planning may reach

}  // namespace

bool Retracing::leads_back(const TraversedPath& path) {
  return path.back_length_m(kBackOffMinM) > kLeadsBackMinM;
}

bool Retracing::can_back_off(const TraversedPath& path, double distance_m) {
  return path.back_length_m(distance_m) > kBackOffMinM;
}

std::optional<double> Retracing::rejoin_length_m(const TraversedPath& path,
                                                 const std::vector<Eigen::Vector2d>& route_odom,
                                                 bool returning_home) const {
  if (failed_) return std::nullopt;
  if (returning_home) {
    if (!leads_back(path)) return std::nullopt;
    return std::min(kRejoinM * (1 + rejoins_ / 2), kRejoinMaxM);
  }
  const double shared_m = path.shared_length_m(route_odom);
  if (shared_m < kSharedMinM) return std::nullopt;
  return std::min(shared_m, kRejoinM);
}

BackOff Retracing::back_off(const TraversedPath& path, double distance_m,
                            const Maneuver& present) const {
  const auto kind = failed_ ? PlanGoal::Kind::kRoute : PlanGoal::Kind::kRetrace;
  return {kind, distance_m, path.back(distance_m), approach_of(present)};
}

Rejoin Retracing::rejoin(const TraversedPath& path, double length_m, bool has_terrain,
                         const Maneuver& present) {
  ++rejoins_;
  const auto kind = has_terrain ? PlanGoal::Kind::kRejoin : PlanGoal::Kind::kRetrace;
  return {kind, length_m, path.poses_back_within(length_m + kRejoinViewM), approach_of(present)};
}

}  // namespace adit
