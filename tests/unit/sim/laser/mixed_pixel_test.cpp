// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A post in front of a wall, measured by beams of finite width.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/sim/laser/laser_fixture.hpp"

namespace adit {
namespace {

constexpr double kPost = 2.9;       // from the laser to its face [m]
constexpr double kPostHalf = 0.1;   // of its width [m]
constexpr double kOuterBeam = 0.5;  // limit of the wall [rad]

World post_before_wall(double wall_m) {
  return box_tunnel({40.0, 40.0, 2.0}, [wall_m](MeshBuilder& builder) {
    builder.begin_part(PartKind::kPost, Material::kRock, "post");
    builder.box(level_box({kPost + 0.1, 0.0, 1.0}, {0.2, 2.0 * kPostHalf, 2.0}));
    builder.begin_part(PartKind::kWall, Material::kRock, "wall");
    builder.box(level_box({wall_m + 0.5, 0.0, 1.0}, {1.0, 10.0, 2.0}));
  });
}

struct Counts {
  int post = 0;
  int wall = 0;
  int between = 0;
};

/// Checks the beams that hit one surface only, and classifies those at the edges.
Counts scan_edge(double wall_m) {
  const World world = post_before_wall(wall_m);
  const RayScene scene(world.mesh);
  LaserParams params = perfect_laser();
  params.subrays = 9;
  LaserModel laser(scene, params, 1);
  const double edge = std::atan(kPostHalf / kPost);
  const double half_width = params.spot_m / 2.0 / kPost + params.divergence_rad / 2.0;
  Counts edges;
  for (double yaw = 0.0; yaw < 0.0087; yaw += 0.0005) {  // from one beam to the next
    const LaserScan scan = scan_at_rest(laser, laser_at({0.0, 0.0, 1.0}, yaw));
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double angle = beam_angle(scan, i) + yaw;
      if (std::abs(angle) > kOuterBeam) continue;
      const double to_post = kPost / std::cos(angle);
      const double to_wall = wall_m / std::cos(angle);
      const double range = scan.ranges_m[i];
      // The range to an oblique wall varies over the width of a beam; the mean is within this.
      const double near = 0.001;
      if (std::abs(angle) + half_width < edge) {
        EXPECT_NEAR(range, to_post, near) << angle;
      } else if (std::abs(angle) - half_width > edge) {
        EXPECT_NEAR(range, to_wall, near) << angle;
      } else {
        EXPECT_GT(range, to_post - near);
        EXPECT_LT(range, to_wall + near);
        const double post_side = to_post + 0.01;
        const double wall_side = to_wall - 0.01;
        ++(range < post_side ? edges.post : range > wall_side ? edges.wall : edges.between);
      }
    }
  }
  return edges;
}

TEST(MixedPixels, AppearAtEdgesOnly) {
  const Counts edges = scan_edge(kPost + 0.4);
  EXPECT_GT(edges.between, 10);
}

TEST(MixedPixels, DoNotAppearBetweenSurfacesFartherApartThanAPulse) {
  const Counts edges = scan_edge(kPost + 0.6);
  EXPECT_EQ(edges.between, 0);
  EXPECT_GT(edges.post, 0);
  EXPECT_GT(edges.wall, 0);
}

}  // namespace
}  // namespace adit
