// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/guarded_drives.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/geometry/in_plan.hpp"
#include "common/messages/drive_command.hpp"
#include "common/messages/driving_state.hpp"
#include "common/messages/plan_goal.hpp"
#include "common/messages/planned_path.hpp"
#include "common/messages/pose.hpp"
#include "common/messages/scan_request.hpp"
#include "common/messages/stop_order.hpp"
#include "procs/driving/driving_node.hpp"
#include "procs/guard/guard_node.hpp"
#include "procs/planning/planning_node.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/terrain/terrain_node.hpp"
#include "sim/vehicle/body_clearance.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/drift_line.hpp"
#include "tests/support/groundhog_params.hpp"
#include "tests/support/robot_that_matches_scans.hpp"
#include "tests/support/true_lateral_error.hpp"

namespace adit {
namespace {

using Kind = DrivingState::Kind;

constexpr double kStepS = 0.1;
constexpr double kLongestS = 120.0;
constexpr double kSweepS = 10.0;
constexpr double kFreeM = 0.6;           // farthest that is looked at
constexpr std::size_t kPointsAhead = 4;  // of 15 cm

/// The vehicle with what the guard wants to be left beside and ahead of it.
Vehicle with_margins() {
  Vehicle vehicle;
  vehicle.width_m += 2.0 * ObstacleParams{}.side_margin_m;
  vehicle.length_m += 2.0 * ObstacleParams{}.margin_m;
  return vehicle;
}

class GuardedRun {
 public:
  explicit GuardedRun(const WorldDescription& mine)
      : drift_(drift_lines(mine.plan).front()), robot_(build_world(mine)) {
    subscribe<planned_path_t>(bus_, channels::kPath, Delivery::latest(),
                              [this](const PlannedPath& path) { path_ = path; });
    subscribe<driving_state_t>(bus_, channels::kDrivingState, Delivery::queued(10),
                               [this](const DrivingState& state) { state_ = state; });
    subscribe<pose_t>(bus_, channels::kPose, Delivery::latest(),
                      [this](const StampedPose& pose) { T_odom_body_ = pose.T_odom_body; });
    subscribe<stop_t>(bus_, channels::kStop, Delivery::queued(10),
                      [this](const StopOrder& order) { hear(order); });
    robot_.run(1.5);
  }

  GuardedDrive look_and_drive(int id, double distance_m) {
    drive_ = {};
    publish(bus_, channels::kScanRequest,
            to_message(ScanRequest{bus_.now_utime(), id, LaserId::kFront}));
    robot_.run(kSweepS);
    anchor();
    path_ = {};
    publish(bus_, channels::kGoal, to_message(goal(id, distance_m)));
    drive_.outcome = path_.outcome;
    drive_.reason = path_.reason;
    if (path_.outcome == PlanOutcome::kFound) drive();
    drive_.failure = robot_.simulation().state().failure;
    return drive_;
  }

 private:
  [[nodiscard]] const BodyMotion& motion() const { return robot_.simulation().vehicle().motion(); }

  /// What scan matching got wrong so far is no error of those who drive.
  void anchor() { T_odom_world_ = T_odom_body_ * in_plan(motion().T_world_body).inverse(); }

  [[nodiscard]] Pose2 true_pose() const { return T_odom_world_ * in_plan(motion().T_world_body); }

  [[nodiscard]] PlanGoal goal(int id, double distance_m) const {
    const Eigen::Vector2d p_world = in_plan(motion().T_world_body).translation();
    const double s_m = drift_.place_of(p_world).s_m;
    const Eigen::Vector2d ahead = drift_.at(s_m + distance_m).p_world - p_world;
    const double heading = std::atan2(ahead.y(), ahead.x()) + T_odom_world_.theta;
    return {bus_.now_utime(), id, PlanGoal::Kind::kAlong, {0.0, 0.0, heading}, distance_m};
  }

  void drive() {
    TrueLateralError error(path_.points);
    state_ = {};
    driving_now_ = true;
    for (drive_.seconds = 0.0; !over(); drive_.seconds += kStepS) {
      robot_.run(kStepS);
      drive_.lateral_m.push_back(error(true_pose().translation()));
      if (held_) drive_.holds.back().seconds += kStepS;
    }
    driving_now_ = held_ = false;
    drive_.state = state_;
    drive_.path_m = state_.progress_m + state_.remaining_m;
    robot_.run(1.0);
  }

  [[nodiscard]] bool over() const {
    const bool ended = state_.kind == Kind::kArrived || state_.kind == Kind::kFailed;
    return ended || drive_.seconds > kLongestS || !robot_.simulation().state().failure.empty();
  }

  void hear(const StopOrder& order) {
    if (order.stopped && !held_ && driving_now_) {
      drive_.holds.push_back({order.reason, 0.0, free_m(), state_.progress_m, clearance_m(),
                              drive_.lateral_m.empty() ? 0.0 : drive_.lateral_m.back()});
    }
    held_ = order.stopped && driving_now_;
  }

  [[nodiscard]] double clearance_m() const {
    const std::size_t first = nearest_point();
    const std::size_t end = std::min(first + kPointsAhead, path_.points.size());
    double least = path_.points[first].clearance_m;
    for (std::size_t i = first; i < end; ++i) least = std::min(least, path_.points[i].clearance_m);
    return least;
  }

  /// How far the true body, with what the guard wants to be left, can go on along the path without
  /// touching, beside the path as it is.
  [[nodiscard]] double free_m() const {
    const std::vector<PathPoint>& points = path_.points;
    const std::size_t first = nearest_point();
    for (std::size_t i = first; i < points.size(); ++i) {
      const Pose2 way = between(points[first].T_odom_body, points[i].T_odom_body);
      const double way_m = way.translation().norm();
      const Eigen::Isometry3d T_world_there = motion().T_world_body * in_space(way);
      if (touched_part(robot_.site().scene(), with_margins(), T_world_there)) return way_m;
      if (way_m > kFreeM) break;
    }
    return kFreeM;
  }

  [[nodiscard]] std::size_t nearest_point() const {
    const auto off_m = [&](const PathPoint& point) {
      return (point.T_odom_body.translation() - true_pose().translation()).norm();
    };
    const auto nearest = std::min_element(
        path_.points.begin(), path_.points.end(),
        [&](const PathPoint& a, const PathPoint& b) { return off_m(a) < off_m(b); });
    return static_cast<std::size_t>(nearest - path_.points.begin());
  }

  DriftLine drift_;
  RobotThatMatchesScans robot_;
  MemoryBus& bus_ = robot_.bus();
  ScanAssemblyNode scan_assembly_{bus_, with_groundhog_lasers<ScanAssemblyNodeParams>()};
  TerrainNode terrain_{bus_, TerrainParams{}};
  PlanningNode planning_{bus_, PlanningParams{}};
  DrivingNode driving_{bus_, DrivingParams{}};
  GuardNode guard_{bus_, with_groundhog_lasers<GuardParams>()};
  PlannedPath path_;
  DrivingState state_;
  Pose2 T_odom_body_;
  Pose2 T_odom_world_;
  GuardedDrive drive_;
  bool driving_now_ = false;
  bool held_ = false;
};

}  // namespace

std::vector<GuardedDrive> drive_guarded(const WorldDescription& mine, int looks,
                                        double distance_m) {
  GuardedRun run(mine);
  std::vector<GuardedDrive> drives;
  for (int i = 0; i < looks; ++i) {
    drives.push_back(run.look_and_drive(i + 1, distance_m));
    const GuardedDrive& last = drives.back();
    if (last.outcome != PlanOutcome::kFound || !last.failure.empty()) break;
  }
  return drives;
}

}  // namespace adit
