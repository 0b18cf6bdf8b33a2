// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scores/mission_score.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "common/types/body_outline.hpp"
#include "sim/vehicle/surroundings.hpp"
#include "tests/support/robots/exploring_robot.hpp"
#include "tests/support/scores/outcome_name.hpp"
#include "tools/eval/level_consistency.hpp"
#include "tools/eval/map_consistency.hpp"
#include "tools/eval/trajectory_score.hpp"

namespace adit::test {
namespace {

constexpr double kCoverageStepM = 0.5;  // true distance between viewpoints
constexpr double kSlopeMargin = 0.05;   // of the slope that an inflated vehicle surely climbs [rad]

/// The sensors cannot measure the depth of water, so that planning rejects all water.
Vehicle non_wading(Vehicle vehicle) {
  vehicle.wading_depth_max_m = 0.0;
  return vehicle;
}

/// The vehicle with margins for all thresholds: wherever it fits, the real one certainly fits.
Vehicle with_margin(Vehicle vehicle) {
  vehicle = with_outline_grown(non_wading(std::move(vehicle)), MissionTruth::kMarginM);
  vehicle.height_m += 0.25;  // overhead margin of the terrain stage
  // Margin of the terrain stage and ground roughness; half of what a low vehicle has.
  vehicle.belly_clearance_m -= std::min(0.08, 0.5 * vehicle.belly_clearance_m);
  vehicle.step_max_m -= std::min(0.08, 0.5 * vehicle.step_max_m);
  return vehicle;
}

std::string outcome_of(const MissionLog& log) {
  if (!log.failure.empty()) return "failed";
  if (log.phases.empty() || log.phases.back().phase != Phase::kEnded) return "timed out";
  return outcome_name(log.phases.back().outcome);
}

void add_phases(const MissionLog& log, MissionScore& score) {
  for (std::size_t i = 1; i < log.phases.size(); ++i) {
    const Phase before = log.phases[i - 1].phase;
    const Phase now = log.phases[i].phase;
    if (before != Phase::kPlan && before != Phase::kExecute) continue;
    score.rescans += now == Phase::kScan ? 1 : 0;
    score.back_offs += now == Phase::kPlan ? 1 : 0;
  }
  if (log.phases.empty()) return;
  score.reason = log.failure.empty() ? log.phases.back().reason : log.failure;
  score.scans = log.phases.back().scans;
  score.complete = log.phases.back().complete;
}

void add_times(const TimeBudget& budget, MissionScore& score) {
  for (std::size_t i = 0; i < kActivities; ++i) {
    const TimeBudget::Share& share = budget.share(static_cast<Activity>(i));
    score.activity_times[i] = share.times;
    score.activity_s[i] = share.duration_s;
    score.activity_m[i] = share.distance_m;
  }
}

void add_trajectory(const MissionLog& log, MissionScore& score) {
  score.distance_travelled_m = log.distance_travelled_m;
  if (log.truth.empty()) return;
  const Eigen::Vector3d start = log.truth.front().position();
  double low_m = start.z();
  double high_m = start.z();
  for (const TimedPose& at : log.truth) {
    score.distance_from_start_m = (at.position() - start).norm();
    score.farthest_m = std::max(score.farthest_m, score.distance_from_start_m);
    low_m = std::min(low_m, at.z_m);
    high_m = std::max(high_m, at.z_m);
  }
  score.relief_m = high_m - low_m;
  score.simulated_s = 1e-6 * static_cast<double>(log.truth.back().utime - log.truth.front().utime);
  if (log.estimated.empty()) return;
  const TrajectoryScore estimated = score_trajectory(log.estimated, log.truth);
  score.rmse_estimated_m = estimated.anchored.rmse_m;
  score.rmse_estimated_z_m = estimated.anchored.z.rmse_m;
  if (log.mapped.empty()) return;
  const TrajectoryScore mapped = score_trajectory(log.mapped, log.truth);
  score.rmse_m = mapped.anchored.rmse_m;
  score.rmse_xyz_m = {mapped.anchored.x.rmse_m, mapped.anchored.y.rmse_m, mapped.anchored.z.rmse_m};
  score.plan_of_allowed = mapped.plan_of_allowed;
  score.height_of_allowed = mapped.height_of_allowed;
  score.length_ratio = mapped.length_ratio;
}

/// What the loop closures in force measured, against the truth at the begin of their local maps.
void add_loop_closures(const MissionLog& log, MissionScore& score) {
  const auto T_world_local = [&](int map) -> std::optional<Pose2> {
    const auto utime = log.local_map_utimes.find(map);
    if (utime == log.local_map_utimes.end()) return std::nullopt;
    return interpolate(log.truth, utime->second);
  };
  for (const MapConstraint& constraint : log.graph.constraints) {
    if (constraint.kind != MapConstraint::Kind::kLoopClosure) continue;
    const auto from = T_world_local(constraint.measured.from);
    const auto to = T_world_local(constraint.measured.to);
    if (!from || !to) continue;
    const Pose2 error = between(between(*from, *to), constraint.measured.T_from_to);
    const double error_m = error.translation().norm();
    score.loop_closure_error_m = std::max(score.loop_closure_error_m, error_m);
    score.wrong_loop_closures += error_m > MissionScore::kWrongM ? 1 : 0;
  }
}

void add_consistency(const MissionLog& log, MissionScore& score) {
  const LevelConsistency levels =
      score_levels(log.loop_closures, log.local_map_utimes, log.mapped, log.truth);
  score.loop_closures = levels.loop_closures;
  score.between_levels = levels.between_levels;
  score.merged_m = levels.merged_m;
  const auto consistency = score_consistency(log.graph, log.local_map_utimes, log.truth);
  if (!consistency) return;
  score.local_maps = consistency->local_maps;
  score.in_interval = consistency->in_interval;
  score.in_ellipsoid = consistency->in_ellipsoid;
  score.normalised_error_squared = consistency->normalised_error_squared;
}

/// Of the body at these poses, up to kClearanceMaxM: of the largest body around it that touches
/// nothing, grown on all sides, downwards from its belly too.
double least_clearance_m(const std::vector<Eigen::Isometry3d>& bodies, const Site& site,
                         const Vehicle& vehicle) {
  constexpr double kToleranceM = 0.005;
  double least_m = MissionScore::kClearanceMaxM;
  for (const Eigen::Isometry3d& T_world_body : bodies) {
    const auto touches = [&](double margin_m) {
      Vehicle grown = with_outline_grown(vehicle, margin_m);
      grown.belly_clearance_m -= margin_m;
      grown.height_m += margin_m;
      return colliding_part(site.scene(), grown, T_world_body).has_value();
    };
    if (least_m <= kToleranceM || !touches(least_m)) continue;
    double free_m = 0.0;
    while (least_m - free_m > kToleranceM) {
      const double middle_m = 0.5 * (free_m + least_m);
      (touches(middle_m) ? least_m : free_m) = middle_m;
    }
  }
  return least_m;
}

/// Flags of the corridor points that were observed.
std::vector<bool> covered_by(const PlanarMine& mine, const Trajectory& truth) {
  std::vector<bool> covered(mine.corridor.size());
  for (const TimedPose& at : downsampled(truth, kCoverageStepM)) {
    const Eigen::Vector2d body = at.pose.translation();
    for (std::size_t i = 0; i < covered.size(); ++i) {
      const Eigen::Vector2d to_point = mine.corridor[i] - body;
      if (covered[i] || to_point.norm() > MissionTruth::kCoverageRangeM) continue;
      covered[i] = !mine.walls.cast(body, std::atan2(to_point.y(), to_point.x()), to_point.norm());
    }
  }
  return covered;
}

double missed_m(const PlanarMine& mine, const std::vector<bool>& covered) {
  double missed = 0.0;
  for (const Eigen::Vector2d& p : mine.corridor) {
    bool near = false;
    for (std::size_t k = 0; k < covered.size() && !near; ++k) {
      near = covered[k] && (mine.corridor[k] - p).norm() <= ExploringRobot::kMissedM;
    }
    if (!near) missed += PlanarMine::kSpacingM;
  }
  return missed;
}

/// The poses on the floor of a level; where levels meet, those of both.
Trajectory poses_on_level(const Trajectory& poses, const WorldTruth& truth, int level) {
  constexpr double kOnFloorM = 1.0;  // less than half of the distance between levels
  if (truth.levels.size() == 1) return poses;
  Trajectory on_level;
  for (const TimedPose& at : poses) {
    const auto floor_m = truth.floor_at(at.pose.translation(), level);
    if (floor_m && std::abs(*floor_m - at.z_m) < kOnFloorM) on_level.push_back(at);
  }
  return on_level;
}

/// Index of the level of the true pose nearest to a point of the plan.
std::size_t level_near(const Eigen::Vector2d& p_world, const Trajectory& poses,
                       const WorldTruth& truth) {
  const auto nearest =
      std::min_element(poses.begin(), poses.end(), [&](const TimedPose& a, const TimedPose& b) {
        return (a.pose.translation() - p_world).norm() < (b.pose.translation() - p_world).norm();
      });
  if (nearest == poses.end()) return 0;
  const int level = truth.level_at(nearest->position());
  const auto found = std::find(truth.levels.begin(), truth.levels.end(), level);
  return static_cast<std::size_t>(found - truth.levels.begin());
}

}  // namespace

MissionTruth::MissionTruth(const World& world, const Vehicle& vehicle)
    : truth_(world.truth),
      vehicle_(vehicle),
      site_(std::make_unique<Site>(world)),
      mines_(planar_mines(world, non_wading(vehicle), kSlopeMaxRad)),
      mines_with_margin_(planar_mines(world, with_margin(vehicle), kSlopeMaxRad - kSlopeMargin)) {}

MissionScore MissionTruth::score(const MissionLog& log) const {
  MissionScore score;
  score.outcome = outcome_of(log);
  add_phases(log, score);
  add_times(log.budget, score);
  add_trajectory(log, score);
  add_consistency(log, score);
  add_loop_closures(log, score);
  add_coverage(log, score);
  add_verdicts(log, score);
  score.guard_stops = log.guard_stops;
  score.least_clearance_m = least_clearance_m(log.bodies, *site_, vehicle_);
  return score;
}

void MissionTruth::add_coverage(const MissionLog& log, MissionScore& score) const {
  std::size_t covered_points = 0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < mines_.size(); ++i) {
    const Trajectory on_level = poses_on_level(log.truth, truth_, truth_.levels[i]);
    const std::vector<bool> covered = covered_by(mines_[i], on_level);
    covered_points += static_cast<std::size_t>(std::count(covered.begin(), covered.end(), true));
    points += covered.size();
    score.corridor_m += mines_[i].corridor_m();
    score.missed_m += missed_m(mines_[i], covered);
    score.certainly_missed_m +=
        missed_m(mines_with_margin_[i], covered_by(mines_with_margin_[i], on_level));
  }
  if (points > 0) {
    score.covered_share = static_cast<double>(covered_points) / static_cast<double>(points);
  }
}

/// Frontier positions are those of the last map, aligned with the ground truth.
void MissionTruth::add_verdicts(const MissionLog& log, MissionScore& score) const {
  if (!log.report || log.mapped.empty()) return;
  const Pose2 T_world_map = score_trajectory(log.mapped, log.truth).T_world_map;
  for (const BlockedVerdict& verdict : log.verdicts) {
    if (verdict.frontier < 0 ||
        static_cast<std::size_t>(verdict.frontier) >= log.report->frontiers.size()) {
      ++score.route_home_verdicts;
      continue;
    }
    if (verdict.unconfirmed) {
      ++score.unconfirmed;
      continue;
    }
    ++score.verdicts;
    const Frontier& frontier = log.report->frontiers[static_cast<std::size_t>(verdict.frontier)];
    const PlanarMine& mine =
        mines_with_margin_[level_near(T_world_map * frontier.p_map, log.truth, truth_)];
    const bool passable = std::ranges::all_of(kBeyondFrontierM, [&](double beyond_m) {
      return mine.reachable(T_world_map * (frontier.p_map + beyond_m * frontier.direction_map));
    });
    score.false_verdicts += passable ? 1 : 0;
  }
}

}  // namespace adit::test
