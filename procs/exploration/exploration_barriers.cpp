// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Barriers: where they are placed after a planner found no path, and what they close.
#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "procs/exploration/choice/route_point.hpp"
#include "procs/exploration/exploration.hpp"

namespace adit {
namespace {

constexpr double kBehindStartM = 0.5;  // behind the rear of the vehicle
constexpr double kExitRadiusM =
    10.0;  // around the start, within which a frontier may lead out of the mine
constexpr double kOutwards =
    -0.3;  // cosine of the direction of such a frontier to the heading at the start, at most
constexpr double kBeyondReachedM = 0.8;  // beyond the farthest point that the planner reached

FrontierState state_behind(Barrier::Kind barrier) {
  switch (barrier) {
    case Barrier::Kind::kBlocked:
      return FrontierState::kBlocked;
    case Barrier::Kind::kOutsideMine:
      return FrontierState::kOutsideMine;
    case Barrier::Kind::kUnconfirmed:
      return FrontierState::kUnconfirmed;
  }
  return FrontierState::kBlocked;
}

bool is_exit(const Barrier& barrier) { return barrier.kind == Barrier::Kind::kOutsideMine; }

/// Across the heading at the start, relative to local map 0.
Barrier exit_at(double x_m, const char* evidence) {
  return {Barrier::Kind::kOutsideMine, -1, 0, {x_m, 0.0}, {-1.0, 0.0}, evidence};
}

}  // namespace

/// Open air returns no beams, so that the known space may end before the barrier at the exit does.
bool Exploration::leads_out(const DetectedFrontier& detected) const {
  if (std::ranges::none_of(barriers_, is_exit)) return false;
  const Pose2 T_home_map = T_map_home().inverse();
  const Eigen::Vector2d p_home = T_home_map * detected.p_map;
  const Eigen::Vector2d direction = T_home_map * detected.direction_map - T_home_map.translation();
  return p_home.norm() < kExitRadiusM && p_home.x() < params_.vehicle.length_m / 2.0 &&
         direction.x() < kOutwards;
}

/// A robot that starts in mid-corridor has the mine behind it as well: only open air is an exit,
/// or what the operator says. The barrier is behind the robot when that saw it from the start,
/// otherwise in front of it.
void Exploration::add_exit_barrier() {
  if (std::ranges::any_of(barriers_, is_exit) || !known_.pose_of(0)) return;
  const double clear_m = params_.vehicle.length_m / 2.0 + kBehindStartM;
  if (params_.starts_at_portal) {
    barriers_.push_back(exit_at(
        -clear_m, "behind the start: the exit of the mine, as the robot starts at the portal"));
    return;
  }
  if (!params_.exit_behind_start) return;
  const Pose2 T_home_map = T_map_home().inverse();
  for (const auto& [local_map, open] : known_.open_air()) {
    const Eigen::Vector2d p_home = T_home_map * open.p;
    const Eigen::Vector2d direction = T_home_map * open.direction - T_home_map.translation();
    if (p_home.norm() > kExitRadiusM || direction.x() > kOutwards) continue;
    const double x = std::min(-clear_m, p_home.x() < -clear_m ? p_home.x() - clear_m : 0.0);
    barriers_.push_back(exit_at(x, "behind the start: open air, the exit of the mine"));
    return;
  }
}

/// An unconfirmed obstacle on the route home does not close ground that has carried the robot.
std::vector<BarrierLine> Exploration::barrier_lines() const {
  std::vector<BarrierLine> barrier_lines;
  for (const Barrier& barrier : barriers_) {
    if (is_outside_ && is_exit(barrier)) continue;
    const bool passable_where_driven = barrier.kind == Barrier::Kind::kUnconfirmed &&
                                       barrier.frontier == ExplorationDecision::kNoFrontier;
    for (const Pose2& T_map_local : known_.poses_of(barrier.local_map)) {
      barrier_lines.push_back({T_map_local * barrier.p_local,
                               T_map_local * barrier.direction_local - T_map_local.translation(),
                               passable_where_driven});
    }
  }
  return barrier_lines;
}

std::vector<FrontierRegister::BarrierEvidence> Exploration::barrier_evidence() const {
  std::vector<FrontierRegister::BarrierEvidence> evidence;
  for (const Barrier& barrier : barriers_) {
    for (const Pose2& T_map_local : known_.poses_of(barrier.local_map)) {
      evidence.push_back(
          {T_map_local * barrier.p_local, state_behind(barrier.kind), barrier.evidence});
    }
  }
  return evidence;
}

std::optional<double> Exploration::path_length_home_m(const ExplorationState& state) const {
  return from_home_->distance_m(p_atlas_body(state));
}

/// A robot beyond the exit has paths back through it, while frontiers out there stay closed.
void Exploration::set_outside(bool is_outside) {
  if (is_outside_ == is_outside) return;
  is_outside_ = is_outside;
  refresh_space();
}

/// A robot behind a barrier has passed it, so that there is a path. The exit stays, and routes lead
/// through it. Of the others the newest without which a path home exists is removed, or else all of
/// them. If that does not help either, the cause is another one, and all barriers stay.
void Exploration::drop_passed_barriers(const ExplorationState& state) {
  const std::vector<Barrier> all = barriers_;
  if (std::ranges::any_of(all, is_exit)) {
    set_outside(true);
    if (path_length_home_m(state)) return;
    set_outside(false);
  }
  if (std::ranges::all_of(all, is_exit)) return;
  const auto leads_home_with = [&](std::vector<Barrier> barriers) {
    barriers_ = std::move(barriers);
    refresh_space();
    return path_length_home_m(state).has_value();
  };
  std::vector<Barrier> exits;
  std::ranges::copy_if(all, std::back_inserter(exits), is_exit);
  if (!leads_home_with(exits)) {
    barriers_ = all;
    refresh_space();
    return;
  }
  const auto leads_home_without = [&](std::size_t passed) {
    std::vector<Barrier> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(passed));
    return leads_home_with(std::move(others));
  };
  std::size_t i = all.size();
  while (i > 0 && (is_exit(all[i - 1]) || !leads_home_without(i - 1))) --i;
  if (i == 0) leads_home_with(exits);
  refresh();
}

bool Exploration::report_blocked(int frontier, const BlockedEvidence& evidence) {
  if (patrol_target_ && frontier == ExplorationDecision::kNoFrontier) {
    patrol_.mark_unreachable(patrol_target_->local_map, evidence.utime);
    return true;
  }
  const bool is_returning = frontier == ExplorationDecision::kNoFrontier &&
                            decision_.kind == ExplorationDecision::Kind::kHome;
  const Frontier* target = register_.find(frontier);
  if (!is_returning && (target == nullptr || target->state == FrontierState::kExplored))
    return false;
  const bool on_route = decision_.frontier == frontier && !route_.empty();
  // An obstacle far from the frontier does not close it: there may be another path.
  const bool far = on_route && decision_.distance_m > params_.step_m;
  if (!far) register_.block(frontier, evidence.unconfirmed, evidence.reason, evidence.utime);
  if (!on_route) return true;
  const RoutePoint end = point_along(route(), std::max(evidence.reached_m, 0.0) + kBeyondReachedM);
  const Eigen::Vector2d& p_end = route_[end.index];
  const std::optional<PosedTile> anchor = known_.tile_at(p_end);
  if (!anchor) return true;
  const Pose2 T_local_map = anchor->T_map_local.inverse();
  const std::string where =
      is_returning ? "on the route home" : fmt::format("behind frontier {}", frontier);
  barriers_.push_back({evidence.unconfirmed ? Barrier::Kind::kUnconfirmed : Barrier::Kind::kBlocked,
                       frontier, anchor->id, T_local_map * p_end,
                       T_local_map * end.direction - T_local_map.translation(),
                       fmt::format("{}: {}", where, evidence.reason)});
  refresh();
  if (path_length_home_m(state_)) return true;
  barriers_.pop_back();
  register_.block(frontier, evidence.unconfirmed, evidence.reason, evidence.utime);
  refresh();
  return true;
}

/// Retries when no other frontier is left, from wherever the robot is by then. A barrier across a
/// junction may cross another tunnel as well, and an obstacle on the path to one frontier is no
/// evidence for another one. A frontier with evidence of its own stays closed without barriers.
bool Exploration::retry_abandoned(std::int64_t utime) {
  if (!register_.retry_abandoned(utime)) return false;
  std::erase_if(barriers_, [](const Barrier& barrier) { return barrier.frontier >= 0; });
  refresh();
  return true;
}

bool Exploration::reopen(int frontier, std::int64_t utime) {
  if (!register_.reopen(frontier, "reopened by the operator", utime)) return false;
  std::erase_if(barriers_, [&](const Barrier& barrier) { return barrier.frontier == frontier; });
  refresh();
  return true;
}

}  // namespace adit
