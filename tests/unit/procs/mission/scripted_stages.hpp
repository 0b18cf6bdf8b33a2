// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "procs/mission/mission.hpp"

namespace adit {

/// A mission and stages with scripted answers. The robot is on the x axis of odom; odom and map are
/// the same.
class ScriptedStages : public testing::Test {
 protected:
  using Kind = ExplorationDecision::Kind;
  static constexpr std::int64_t kStart = 1'600'000'000'000'000;
  static constexpr std::int64_t kTick = 100'000;
  static constexpr int kLegs = 20;  // of a route

  /// Advances time in ticks; poses and driving states arrive unless disabled.
  void wait(double seconds) {
    for (int i = 0; i < std::lround(10.0 * seconds); ++i) tick();
  }
  void tick() {
    utime_ += kTick;
    if (publishes_poses_) {
      const auto pose = mission_.add_pose(utime_, {x_m_, 0.0, heading_});
      if (pose) stored_.push_back(*pose);
    }
    if (publishes_driving_) mission_.add_driving(driving_);
    note(mission_.advance(utime_));
  }
  void advance() { note(mission_.advance(utime_)); }

  void answer(Kind kind, int frontier = 0, const std::string& reason = "because") {
    ExplorationReport report;
    report.revision = 1;
    report.request = request_.id;
    report.decision.kind = kind;
    report.decision.frontier = kind == Kind::kHome || kind == Kind::kDone ? -1 : frontier;
    report.decision.reason = reason;
    report.decision.distance_m = x_m_ + detour_length_m_;  // home is the origin of odom
    for (int i = 0; i <= kLegs; ++i)
      report.route_odom.emplace_back(x_m_ + reach_m_ * i / kLegs, 0.0);
    mission_.add_exploration(report);
    advance();
  }
  void terrain() {
    terrain_utime_ = utime_;
    mission_.add_terrain(utime_, phase().goal_id);
    advance();
  }
  void path(PlanOutcome outcome, double reached_m = 0.5) {
    PlannedPath path;
    path.utime = terrain_utime_;
    path.id = phase().goal_id;
    path.outcome = outcome;
    path.reason = outcome == PlanOutcome::kFound ? "a path" : "a beam blocks the path";
    path.reached_m = reached_m;
    if (outcome == PlanOutcome::kBlocked && blocks_) path.blocking = {BlockingCell{}};
    mission_.add_path(path);
    advance();
  }
  void driving(DrivingState::Kind kind, const std::string& reason = "") {
    driving_.kind = kind;
    driving_.path_id = phase().goal_id;
    driving_.reason = reason;
  }
  void drive(double path_length_m) {
    driving(DrivingState::Kind::kDriving);
    const int ticks = static_cast<int>(std::lround(path_length_m / 0.25));
    for (int i = 0; i < ticks; ++i) {
      x_m_ += 0.25;
      tick();
    }
  }

  void to_explore() {
    wait(0.2);
    ASSERT_EQ(now(), Phase::kExplore);
  }
  void to_scan(Kind kind = Kind::kGoTo) {
    if (now() != Phase::kExplore) to_explore();
    answer(kind);
    ASSERT_EQ(now(), Phase::kScan);
  }
  void to_plan() {
    if (now() != Phase::kScan) to_scan();
    terrain();
    ASSERT_EQ(now(), Phase::kPlan);
  }
  void to_execute() {
    if (now() != Phase::kPlan) to_plan();
    path(PlanOutcome::kFound);
    ASSERT_EQ(now(), Phase::kExecute);
  }
  void to(Phase phase) {
    if (phase == Phase::kExplore) to_explore();
    if (phase == Phase::kScan) to_scan();
    if (phase == Phase::kPlan) to_plan();
    if (phase == Phase::kExecute) to_execute();
  }
  void arrive() {
    driving(DrivingState::Kind::kArrived);
    tick();
  }
  void map(std::int64_t utime, const std::optional<Eigen::Matrix3d>& covariance = {}) {
    MapCorrection correction;
    correction.utime = utime;
    correction.covariance = covariance;
    mission_.add_correction(correction);
  }
  /// The pose of the body relative to home has this standard deviation in each direction.
  void map_with_body_sd(double sd_m) {
    MapCorrection correction;
    correction.utime = utime_;
    correction.body_covariance = Eigen::Vector3d(sd_m * sd_m, sd_m * sd_m, 1e-4).asDiagonal();
    mission_.add_correction(correction);
  }
  void match(std::int64_t odom_epoch_utime) {
    ScanMatch match;
    match.odom_epoch_utime = odom_epoch_utime;
    match.status = ScanMatch::Status::kMatched;
    mission_.add_match(match);
  }
  void order(MissionOrder::Kind kind) {
    mission_.add_order({utime_, kind});
    advance();
  }

  [[nodiscard]] const MissionPhase& phase() const { return mission_.phase(); }
  [[nodiscard]] Phase now() const { return phase().phase; }

  void note(const MissionRequests& requests) {
    if (requests.explore) request_ = *requests.explore;
    explores_ += requests.explore ? 1 : 0;
    scans_ += requests.scan ? 1 : 0;
    goals_ += requests.goal ? 1 : 0;
    if (requests.scan) scan_ = *requests.scan;
    if (requests.goal) goal_ = *requests.goal;
  }

  Mission mission_{MissionParams{}};
  std::int64_t utime_ = kStart;
  std::int64_t terrain_utime_ = 0;
  double x_m_ = 0.0;
  double heading_ = 0.0;
  double reach_m_ = 10.0;         ///< end of the route; negative: behind
  double detour_length_m_ = 0.0;  ///< added to the path length home
  bool blocks_ = true;            ///< a blocked path has blocking cells
  bool publishes_poses_ = true;
  bool publishes_driving_ = true;
  DrivingState driving_;
  std::vector<StoredPathPose> stored_;  ///< as the journal receives them
  ExploreRequest request_;
  ScanRequest scan_;
  PlanGoal goal_;
  int explores_ = 0, scans_ = 0, goals_ = 0;
};

}  // namespace adit
