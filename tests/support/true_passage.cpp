// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/true_passage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <set>
#include <tuple>

#include "tests/support/true_drive.hpp"

namespace adit {
namespace {

constexpr double kStepM = 0.4;
constexpr int kLooks = 4;  // on the way of a step
constexpr std::array kCurvatures{0.0, 0.25, -0.25, 0.5, -0.5};
constexpr double kCellM = 0.15;
constexpr double kHeadingCell = 0.15;  // [rad]
constexpr double kGreed = 2.0;         // a metre on along the drift is worth that of way

struct State {
  double order;
  Pose2 T_world_body;
  double floor_m;
  double way_m;

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
    enter(corridor_.T_world_robot, corridor_.T_world_body.translation().z(), 0.0);
    while (!open_.empty() && farthest_m_ < enough_m) {
      const State state = open_.top();
      open_.pop();
      for (const double curvature : kCurvatures) drive(state, curvature);
    }
    return farthest_m_;
  }

 private:
  void enter(const Pose2& pose, double floor_m, double way_m) {
    if (!seen_.insert(bin(pose)).second) return;
    const double along_m = corridor_.drift.place_of(pose.translation()).s_m - kCorridorStart;
    farthest_m_ = std::max(farthest_m_, along_m);
    open_.push({way_m - kGreed * along_m, pose, floor_m, way_m});
  }

  void drive(const State& from, double curvature) {
    Pose2 pose = from.T_world_body;
    double floor_m = from.floor_m;
    const double turn = curvature * kStepM / kLooks;
    for (int i = 0; i < kLooks; ++i) {
      pose = pose * Pose2{0.0, 0.0, turn / 2.0} * Pose2{kStepM / kLooks, 0.0, turn / 2.0};
      if (stance_.put(pose, floor_m)) return;
      if (fault_around(*corridor_.site, vehicle_, stance_.T_world_body())) return;
      floor_m = stance_.T_world_body().translation().z();
    }
    enter(pose, floor_m, from.way_m + kStepM);
  }

  const Corridor& corridor_;
  Vehicle vehicle_;
  Stance stance_;
  std::priority_queue<State> open_;
  std::set<std::tuple<long, long, long>> seen_;
  double farthest_m_ = 0.0;
};

}  // namespace

Vehicle with_room(const Vehicle& vehicle, double room_m) {
  Vehicle larger = vehicle;
  larger.length_m += 2.0 * room_m;
  larger.width_m += 2.0 * room_m;
  larger.height_m += 0.25;           // with which the terrain stage looks for what hangs
  larger.belly_clearance_m -= 0.08;  // the margin, and roughness of the ground
  larger.step_max_m -= 0.08;
  larger.tilt_max_rad = 0.25;
  larger.wading_depth_max_m = 0.0;  // all water is refused
  return larger;
}

double true_passage(const Corridor& corridor, const Vehicle& vehicle, double enough_m) {
  return Passage(corridor, vehicle).search(enough_m);
}

}  // namespace adit
