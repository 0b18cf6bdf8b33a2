// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/mission_score.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/exploring_robot.hpp"
#include "tools/eval/trajectory_score.hpp"

namespace adit::test {
namespace {

constexpr double kLookM = 0.5;  // of the true way, from one look around to the next

/// Nobody sees how deep water is, so that all of it is refused.
Vehicle that_does_not_wade() {
  Vehicle vehicle;
  vehicle.wading_depth_max_m = 0.0;
  return vehicle;
}

/// What it can do, nobody doubts.
Vehicle with_room_round_it() {
  Vehicle vehicle = that_does_not_wade();
  vehicle.length_m += 2.0 * MissionTruth::kRoomM;
  vehicle.width_m += 2.0 * MissionTruth::kRoomM;
  vehicle.height_m += 0.25;           // with which the terrain stage looks for what hangs
  vehicle.belly_clearance_m -= 0.08;  // its margin, and roughness of the ground
  vehicle.step_max_m -= 0.08;
  return vehicle;
}

std::string outcome_of(const MissionLog& log) {
  if (!log.failure.empty()) return "failed";
  if (log.phases.empty() || log.phases.back().phase != Phase::kEnded) return "timed out";
  switch (log.phases.back().outcome) {
    case MissionOutcome::kHome:
      return "home";
    case MissionOutcome::kStopped:
      return "stopped";
    default:
      return "stranded";
  }
}

void add_phases(const MissionLog& log, MissionScore& score) {
  for (std::size_t i = 1; i < log.phases.size(); ++i) {
    const Phase before = log.phases[i - 1].phase;
    const Phase now = log.phases[i].phase;
    if (before != Phase::kPlan && before != Phase::kExecute) continue;
    score.other_laser += now == Phase::kScan ? 1 : 0;
    score.back_offs += now == Phase::kPlan ? 1 : 0;
  }
  if (log.phases.empty()) return;
  score.reason = log.failure.empty() ? log.phases.back().reason : log.failure;
  score.scans = log.phases.back().scans;
  score.complete = log.phases.back().complete;
}

void add_way(const MissionLog& log, MissionScore& score) {
  score.travelled_m = log.travelled_m;
  if (log.truth.empty()) return;
  const Eigen::Vector2d start = log.truth.front().pose.translation();
  for (const TimedPose& at : log.truth) {
    score.home_off_m = (at.pose.translation() - start).norm();
    score.farthest_m = std::max(score.farthest_m, score.home_off_m);
  }
  score.simulated_s = 1e-6 * static_cast<double>(log.truth.back().utime - log.truth.front().utime);
  if (log.believed.empty()) return;
  score.rmse_believed_m = score_trajectory(log.believed, log.truth).anchored.rmse_m;
  if (log.mapped.empty()) return;
  const TrajectoryScore mapped = score_trajectory(log.mapped, log.truth);
  score.rmse_m = mapped.anchored.rmse_m;
  score.length_ratio = mapped.length_ratio;
}

/// Which places of the corridor were seen.
std::vector<bool> seen_of(const LightMine& mine, const Trajectory& truth) {
  std::vector<bool> seen(mine.corridor.size());
  for (const TimedPose& at : thinned(truth, kLookM)) {
    const Eigen::Vector2d body = at.pose.translation();
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Eigen::Vector2d way = mine.corridor[i] - body;
      if (seen[i] || way.norm() > MissionTruth::kSightM) continue;
      seen[i] = !mine.walls.cast(body, std::atan2(way.y(), way.x()), way.norm());
    }
  }
  return seen;
}

double missed_m(const LightMine& mine, const std::vector<bool>& seen) {
  double missed = 0.0;
  for (const Eigen::Vector2d& p : mine.corridor) {
    bool near = false;
    for (std::size_t k = 0; k < seen.size() && !near; ++k) {
      near = seen[k] && (mine.corridor[k] - p).norm() <= ExploringRobot::kMissedM;
    }
    if (!near) missed += LightMine::kSpacingM;
  }
  return missed;
}

}  // namespace

MissionTruth::MissionTruth(const World& world)
    : mine_(light_mine(world, that_does_not_wade())),
      roomy_(light_mine(world, with_room_round_it())) {}

MissionScore MissionTruth::score(const MissionLog& log) const {
  MissionScore score;
  score.outcome = outcome_of(log);
  add_phases(log, score);
  add_way(log, score);
  add_coverage(log, score);
  add_verdicts(log, score);
  score.guard_stops = log.guard_stops;
  return score;
}

void MissionTruth::add_coverage(const MissionLog& log, MissionScore& score) const {
  score.corridor_m = mine_.corridor_m();
  const std::vector<bool> seen = seen_of(mine_, log.truth);
  const auto n = static_cast<double>(std::count(seen.begin(), seen.end(), true));
  if (!seen.empty()) score.seen_share = n / static_cast<double>(seen.size());
  score.missed_m = missed_m(mine_, seen);
  score.sure_missed_m = missed_m(roomy_, seen_of(roomy_, log.truth));
}

/// By where the stub is on the last map, laid upon the truth.
void MissionTruth::add_verdicts(const MissionLog& log, MissionScore& score) const {
  if (!log.report || log.mapped.empty()) return;
  const Pose2 T_world_map = score_trajectory(log.mapped, log.truth).T_world_map;
  for (const BlockedVerdict& verdict : log.verdicts) {
    if (verdict.stub < 0 || static_cast<std::size_t>(verdict.stub) >= log.report->stubs.size()) {
      ++score.home_verdicts;
      continue;
    }
    if (verdict.doubtful) {
      ++score.doubtful;
      continue;
    }
    ++score.verdicts;
    const Stub& stub = log.report->stubs[static_cast<std::size_t>(verdict.stub)];
    const Eigen::Vector2d beyond = stub.p_map + kBeyondM * stub.direction_map;
    score.false_verdicts += roomy_.reachable(T_world_map * beyond) ? 1 : 0;
  }
}

}  // namespace adit::test
