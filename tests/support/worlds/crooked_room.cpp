// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/worlds/crooked_room.hpp"

#include <Eigen/Core>

#include "common/sensing/laser_mount.hpp"

namespace adit::test {
namespace {

void add_closed(std::vector<Segment>& walls, const std::vector<Eigen::Vector2d>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
}

}  // namespace

WallWorld crooked_room() {
  std::vector<Segment> walls;
  add_closed(walls, {{-6, -3}, {2, -4}, {7, -1}, {6, 4}, {1, 3}, {0, 5}, {-5, 4}});
  add_closed(walls, {{2, 0}, {2.6, 0.2}, {2.4, 0.8}, {1.8, 0.6}});
  return WallWorld(walls);
}

std::vector<SurfacePoint> scan_points(const LaserScan& scan) {
  return surface_points(scan, LaserMount{}, SurfaceParams{});
}

std::vector<SurfacePoint> scan_points(const WallWorld& world, const Pose2& T_world_body) {
  return scan_points(exact_scan(world, T_world_body, 1'000'000));
}

}  // namespace adit::test
