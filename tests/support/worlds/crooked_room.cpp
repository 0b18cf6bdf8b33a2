// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/worlds/crooked_room.hpp"

namespace adit::test {
namespace {

void add_closed(std::vector<Segment>& walls, const std::vector<Eigen::Vector2d>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
}

}  // namespace

SyntheticWorld crooked_room() {
  std::vector<Segment> walls;
  add_closed(walls, {{-6, -3}, {2, -4}, {7, -1}, {6, 4}, {1, 3}, {0, 5}, {-5, 4}});
  add_closed(walls, {{2, 0}, {2.6, 0.2}, {2.4, 0.8}, {1.8, 0.6}});
  return SyntheticWorld(walls);
}

SyntheticLaserModel perfect_laser() {
  SyntheticLaserModel laser;
  laser.noise_sd_m = 0.0;
  laser.quantum_m = 0.0;
  return laser;
}

std::vector<SurfacePoint> scan_points(const SyntheticWorld& world, const Pose2& T_world_body,
                                      const SyntheticLaserModel& laser, std::uint64_t seed) {
  SyntheticLaser eye(laser, seed);
  return surface_points(eye.measure(world, T_world_body, 1'000'000), LaserMount{}, SurfaceParams{});
}

}  // namespace adit::test
