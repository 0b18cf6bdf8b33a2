// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/drives/guarded_drives.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/geometry/pose2.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "procs/driving/driving_node.hpp"
#include "procs/guard/guard_node.hpp"
#include "procs/planning/planning_node.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/terrain/terrain_node.hpp"
#include "sim/vehicle/surroundings.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/random/random_generator.hpp"
#include "tests/support/robots/simulated_robot.hpp"
#include "tests/support/scores/cross_track_error.hpp"

namespace adit {
namespace {

constexpr double kLengthM = 45.0;
constexpr double kLaneFreeM = 7.0;  // before the first obstacle
constexpr const char* kTunnel = "main";

TunnelDescription bent_tunnel(RandomGenerator& rng) {
  TunnelDescription tunnel;
  tunnel.name = kTunnel;
  tunnel.width_m = rng.between(2.9, 4.2);
  tunnel.points_m = {0.0, 0.0, 8.0, 0.0};
  double heading = 0.0;
  for (double remaining_m = kLengthM - 8.0; remaining_m > 0.0;) {
    const double segment_m = rng.between(5.0, 9.0);
    heading = std::clamp(heading + rng.between(-0.5, 0.5), -1.2, 1.2);
    const std::size_t last = tunnel.points_m.size() - 2;
    tunnel.points_m.push_back(tunnel.points_m[last] + segment_m * std::cos(heading));
    tunnel.points_m.push_back(tunnel.points_m[last + 1] + segment_m * std::sin(heading));
    remaining_m -= segment_m;
  }
  return tunnel;
}

/// A random lateral position for an obstacle of that radius: between the edge of the free lane and
/// the wall, on a random side.
double across_m(double width_m, double lane_m, double radius_m, RandomGenerator& rng) {
  const double outermost = width_m / 2.0;
  const double innermost = std::min(outermost, lane_m + radius_m - width_m / 2.0);
  return rng.side() * rng.between(std::max(0.0, innermost), outermost);
}

void add_obstacles(double width_m, double lane_m, WorldDescription& world, RandomGenerator& rng) {
  for (double s_m = kLaneFreeM; s_m < kLengthM - 3.0; s_m += rng.between(2.5, 6.0)) {
    if (rng.chance(0.7)) {
      const double radius_m = rng.between(0.06, 0.15);
      world.props.posts.push_back({.tunnel = kTunnel,
                                   .from_m = s_m,
                                   .to_m = s_m,
                                   .across_m = across_m(width_m, lane_m, radius_m, rng),
                                   .radius_m = radius_m});
    } else {
      const double radius_m = rng.between(0.3, 0.8);
      world.props.rubble.push_back({.tunnel = kTunnel,
                                    .at_m = s_m,
                                    .across_m = across_m(width_m, lane_m, radius_m, rng),
                                    .radius_m = radius_m,
                                    .height_m = rng.between(0.3, 0.8)});
    }
  }
  if (rng.chance(0.3)) {
    world.props.rails.push_back({.tunnel = kTunnel, .from_m = 0.0, .to_m = kLengthM - 10.0});
  }
}

}  // namespace

WorldDescription random_tunnel(int seed, double lane_m) {
  RandomGenerator rng(static_cast<std::uint64_t>(seed));
  WorldDescription world;
  world.name = "tunnel_to_drive_" + std::to_string(seed);
  world.seed = seed;
  world.T_world_start = {3.0, 0.0, 0.0};
  world.plan.tunnels.push_back(bent_tunnel(rng));
  add_obstacles(world.plan.tunnels.front().width_m, lane_m, world, rng);
  return world;
}

namespace {

using Kind = DrivingState::Kind;

constexpr double kStepS = 0.1;
constexpr double kTimeMaxS = 120.0;
constexpr double kSweepS = 10.0;
constexpr double kFreeM = 0.6;           // limit of GuardStop::free_m
constexpr std::size_t kPointsAhead = 4;  // 15 cm apart

/// The vehicle enlarged by the guard's margins at the sides and ahead.
Vehicle vehicle_with_margins() {
  Vehicle vehicle;
  vehicle.width_m += 2.0 * ObstacleParams{}.side_margin_m;
  vehicle.length_m += 2.0 * ObstacleParams{}.margin_m;
  return vehicle;
}

class GuardedRun {
 public:
  explicit GuardedRun(const WorldDescription& mine)
      : tunnel_(tunnel_lines(mine.plan).front()), robot_(build_world(mine)) {
    subscribe<planned_path_t>(bus_, channels::kPath, Delivery::latest(),
                              [this](const PlannedPath& path) { path_ = path; });
    subscribe<driving_state_t>(bus_, channels::kDrivingState, Delivery::queued(10),
                               [this](const DrivingState& state) { state_ = state; });
    subscribe<pose_t>(bus_, channels::kPose, Delivery::latest(),
                      [this](const StampedPose& pose) { T_odom_body_ = pose.T_odom_body; });
    subscribe<stop_t>(bus_, channels::kStop, Delivery::queued(10),
                      [this](const StopOrder& order) { on_stop_order(order); });
    robot_.run(1.5);
  }

  GuardedDrive scan_and_drive(int id, double distance_m) {
    drive_ = {};
    publish(bus_, channels::kScanRequest,
            to_message(ScanRequest{bus_.now_utime(), id, LaserId::kFront}));
    robot_.run(kSweepS);
    update_odom_world();
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

  /// Aligns odom with world at the current pose, so that the previous errors of scan matching do
  /// not count as driving errors.
  void update_odom_world() {
    T_odom_world_ = T_odom_body_ * in_plan(motion().T_world_body).inverse();
  }

  [[nodiscard]] Pose2 true_pose() const { return T_odom_world_ * in_plan(motion().T_world_body); }

  [[nodiscard]] PlanGoal goal(int id, double distance_m) const {
    const Eigen::Vector2d p_world = in_plan(motion().T_world_body).translation();
    const double s_m = tunnel_.place_of(p_world).s_m;
    const Eigen::Vector2d ahead = tunnel_.at(s_m + distance_m).p_world - p_world;
    const double heading = std::atan2(ahead.y(), ahead.x()) + T_odom_world_.theta;
    return {bus_.now_utime(), id, PlanGoal::Kind::kAlong, {0.0, 0.0, heading}, distance_m};
  }

  void drive() {
    CrossTrackError error(path_.points);
    state_ = {};
    is_driving_ = true;
    for (drive_.seconds = 0.0; !finished(); drive_.seconds += kStepS) {
      robot_.run(kStepS);
      drive_.cross_track_error_m.push_back(error(true_pose().translation()));
      if (stopped_by_guard_) drive_.guard_stops.back().seconds += kStepS;
    }
    is_driving_ = stopped_by_guard_ = false;
    drive_.state = state_;
    drive_.path_m = state_.progress_m + state_.remaining_m;
    robot_.run(1.0);
  }

  [[nodiscard]] bool finished() const {
    const bool ended = state_.kind == Kind::kArrived || state_.kind == Kind::kFailed;
    return ended || drive_.seconds > kTimeMaxS || !robot_.simulation().state().failure.empty();
  }

  void on_stop_order(const StopOrder& order) {
    if (order.stopped && !stopped_by_guard_ && is_driving_) {
      drive_.guard_stops.push_back(
          {order.reason, 0.0, free_m(), state_.progress_m, clearance_m(),
           drive_.cross_track_error_m.empty() ? 0.0 : drive_.cross_track_error_m.back()});
    }
    stopped_by_guard_ = order.stopped && is_driving_;
  }

  [[nodiscard]] double clearance_m() const {
    const std::size_t first = nearest_point();
    const std::size_t end = std::min(first + kPointsAhead, path_.points.size());
    double least = path_.points[first].clearance_m;
    for (std::size_t i = first; i < end; ++i) least = std::min(least, path_.points[i].clearance_m);
    return least;
  }

  /// Distance that the true vehicle, enlarged by the guard's margins, can move parallel to the path
  /// without a collision. It keeps its current offset from the path.
  [[nodiscard]] double free_m() const {
    const std::vector<PathPoint>& points = path_.points;
    const std::size_t first = nearest_point();
    for (std::size_t i = first; i < points.size(); ++i) {
      const Pose2 T_first_point = between(points[first].T_odom_body, points[i].T_odom_body);
      const double free_distance_m = T_first_point.translation().norm();
      const Eigen::Isometry3d T_world_ahead = motion().T_world_body * in_space(T_first_point);
      if (colliding_part(robot_.site().scene(), vehicle_with_margins(), T_world_ahead))
        return free_distance_m;
      if (free_distance_m > kFreeM) break;
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

  TunnelLine tunnel_;
  ScanMatchingRobot robot_;
  MemoryBus& bus_ = robot_.bus();
  ScanAssemblyNode scan_assembly_{bus_, with_groundhog_lasers<ScanAssemblyNodeParams>()};
  TerrainNode terrain_{bus_, TerrainParams{}};
  PlanningNode planning_{bus_, PlanningParams{}};
  DrivingParams driving_params_;
  DrivingNode driving_{bus_, driving_params_};
  GuardNode guard_{bus_, with_groundhog_lasers<GuardParams>()};
  PlannedPath path_;
  DrivingState state_;
  Pose2 T_odom_body_;
  Pose2 T_odom_world_;
  GuardedDrive drive_;
  bool is_driving_ = false;
  bool stopped_by_guard_ = false;
};

}  // namespace

std::vector<GuardedDrive> drive_guarded(const WorldDescription& mine, int scans,
                                        double distance_m) {
  GuardedRun run(mine);
  std::vector<GuardedDrive> drives;
  for (int i = 0; i < scans; ++i) {
    drives.push_back(run.scan_and_drive(i + 1, distance_m));
    const GuardedDrive& last = drives.back();
    if (last.outcome != PlanOutcome::kFound || !last.failure.empty()) break;
  }
  return drives;
}

}  // namespace adit
