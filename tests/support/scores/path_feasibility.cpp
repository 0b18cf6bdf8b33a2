// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scores/path_feasibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <set>
#include <tuple>

#include "sim/vehicle/surroundings.hpp"

namespace adit {
namespace {

constexpr double kFeasibilityStepM = 0.01;  // motion of the corners between checks
constexpr double kCornerM = 1.4;            // distance of a corner from the centre, upper bound

}  // namespace

std::optional<std::string> find_fault_at(const Site& site, const Vehicle& vehicle,
                                         const Eigen::Isometry3d& T_world_body) {
  if (const auto part = colliding_part(site.scene(), vehicle, T_world_body)) {
    return "touches '" + *part + "'";
  }
  for (const double x : {-0.5, 0.0, 0.5}) {
    for (const double y : {-0.5, 0.0, 0.5}) {
      const Eigen::Vector3d p =
          T_world_body * Eigen::Vector3d(x * vehicle.wheelbase_m, y * vehicle.track_m, 0.0);
      const auto water = water_above(site.world(), p);
      if (water && water->depth_m > vehicle.wading_depth_max_m) return "in deep water";
    }
  }
  return std::nullopt;
}

std::optional<FeasibilityFault> find_first_fault(const Site& site, const Vehicle& vehicle,
                                                 double floor_m, const std::vector<Pose2>& poses) {
  if (poses.empty()) return std::nullopt;
  Stance stance(site, vehicle);
  double driven_m = 0.0;
  const auto fault_at = [&](const Pose2& pose,
                            Stance::Fault fault) -> std::optional<FeasibilityFault> {
    if (!fault) fault = find_fault_at(site, vehicle, stance.T_world_body());
    if (!fault) return std::nullopt;
    return FeasibilityFault{pose, driven_m, *fault};
  };
  if (auto fault = fault_at(poses.front(), stance.put(poses.front(), floor_m))) return fault;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Pose2 step = between(poses[i - 1], poses[i]);
    const double length_m = step.translation().norm();
    const int steps = static_cast<int>(
        std::ceil((length_m + kCornerM * std::abs(step.theta)) / kFeasibilityStepM));
    for (int k = 1; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      const Pose2 pose = poses[i - 1] * Pose2{share * step.x, share * step.y, share * step.theta};
      driven_m += length_m / steps;
      if (auto fault = fault_at(pose, stance.move(pose))) return fault;
    }
  }
  return std::nullopt;
}

namespace {

constexpr double kPassageStepM = 0.4;
constexpr int kCheckedPoses = 4;  // per step
constexpr std::array kCurvatures{0.0, 0.25, -0.25, 0.5, -0.5};
constexpr double kCellM = 0.15;
constexpr double kHeadingCell = 0.15;     // [rad]
constexpr double kHeuristicWeight = 2.0;  // of progress along the tunnel against path length

struct State {
  double order;
  Pose2 T_world_body;
  double floor_m;
  double driven_m;

  friend bool operator<(const State& a, const State& b) { return a.order > b.order; }
};

std::tuple<long, long, long> bin(const Pose2& pose) {
  return {std::lround(pose.x / kCellM), std::lround(pose.y / kCellM),
          std::lround(pose.theta / kHeadingCell)};
}

class Passage {
 public:
  Passage(const Corridor& corridor, const Vehicle& vehicle)
      : corridor_(corridor), vehicle_(vehicle), stance_(*corridor.site, vehicle) {}

  double search(double enough_m) {
    add_node(corridor_.T_world_robot, corridor_.T_world_body.translation().z(), 0.0);
    while (!open_.empty() && farthest_m_ < enough_m) {
      const State state = open_.top();
      open_.pop();
      for (const double curvature : kCurvatures) drive(state, curvature);
    }
    return farthest_m_;
  }

 private:
  void add_node(const Pose2& pose, double floor_m, double driven_m) {
    if (!visited_.insert(bin(pose)).second) return;
    const double along_m = corridor_.tunnel.place_of(pose.translation()).s_m - kCorridorStart;
    farthest_m_ = std::max(farthest_m_, along_m);
    open_.push({driven_m - kHeuristicWeight * along_m, pose, floor_m, driven_m});
  }

  void drive(const State& from, double curvature) {
    Pose2 pose = from.T_world_body;
    double floor_m = from.floor_m;
    const double turn = curvature * kPassageStepM / kCheckedPoses;
    for (int i = 0; i < kCheckedPoses; ++i) {
      pose = pose * Pose2{0.0, 0.0, turn / 2.0} *
             Pose2{kPassageStepM / kCheckedPoses, 0.0, turn / 2.0};
      if (stance_.put(pose, floor_m)) return;
      if (find_fault_at(*corridor_.site, vehicle_, stance_.T_world_body())) return;
      floor_m = stance_.T_world_body().translation().z();
    }
    add_node(pose, floor_m, from.driven_m + kPassageStepM);
  }

  const Corridor& corridor_;
  Vehicle vehicle_;
  Stance stance_;
  std::priority_queue<State> open_;
  std::set<std::tuple<long, long, long>> visited_;
  double farthest_m_ = 0.0;
};

}  // namespace

Vehicle inflated_vehicle(const Vehicle& vehicle, double room_m) {
  Vehicle larger = vehicle;
  larger.length_m += 2.0 * room_m;
  larger.width_m += 2.0 * room_m;
  larger.height_m += 0.25;           // overhead margin of the terrain stage
  larger.belly_clearance_m -= 0.08;  // margin of the terrain stage and ground roughness
  larger.step_max_m -= 0.08;
  larger.tilt_max_rad = 0.25;
  larger.wading_depth_max_m = 0.0;  // planning rejects all water
  return larger;
}

double feasible_distance_m(const Corridor& corridor, const Vehicle& vehicle, double enough_m) {
  return Passage(corridor, vehicle).search(enough_m);
}

}  // namespace adit
