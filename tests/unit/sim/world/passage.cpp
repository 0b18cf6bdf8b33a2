// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/sim/world/passage.hpp"

#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace adit {
namespace {

constexpr double kStep = 0.2;   // along and across [m]
constexpr double kTurn = 0.15;  // [rad]
constexpr int kTurnsMax = 5;    // to either side of the tunnel's direction

using State = std::array<int, 3>;  // steps along, across, of heading

}  // namespace

bool is_free(const Site& site, const Body& body, const Pose2& T_world_body) {
  const auto floor = site.world().truth.floor_height(T_world_body.translation());
  if (!floor) return false;
  OrientedBox box;
  box.T_world_box.translation() << T_world_body.x, T_world_body.y,
      *floor + (body.belly_m + body.height_m) / 2.0;
  box.T_world_box.rotate(Eigen::AngleAxisd(T_world_body.theta, Eigen::Vector3d::UnitZ()));
  box.half_size = {body.length_m / 2.0, body.width_m / 2.0, (body.height_m - body.belly_m) / 2.0};
  return site.scene().touching(box).empty();
}

bool is_passable(const Site& site, const Body& body, const TunnelLine& tunnel, double from_m,
                 double to_m) {
  const int last = static_cast<int>((to_m - from_m) / kStep);
  const int across = static_cast<int>(tunnel.width_m / 2.0 / kStep);
  const auto pose = [&](const State& state) {
    const double s_m = from_m + kStep * state[0];
    const Eigen::Vector2d p = tunnel.beside(s_m, kStep * state[1]);
    return Pose2{p.x(), p.y(), tunnel.at(s_m).heading_rad + kTurn * state[2]};
  };
  std::set<State> seen;
  std::vector<State> open;
  const auto visit = [&](const State& state) {
    const bool within =
        state[0] >= 0 && std::abs(state[1]) <= across && std::abs(state[2]) <= kTurnsMax;
    if (!within || !seen.insert(state).second || !is_free(site, body, pose(state))) return;
    open.push_back(state);
  };
  for (int i = -across; i <= across; ++i) visit({0, i, 0});
  while (!open.empty()) {
    const State state = open.back();
    open.pop_back();
    if (state[0] >= last) return true;
    for (std::size_t axis : {1U, 2U, 0U}) {
      for (const int step : {-1, 1}) {
        State next = state;
        next[axis] += step;
        visit(next);
      }
    }
  }
  return false;
}

}  // namespace adit
