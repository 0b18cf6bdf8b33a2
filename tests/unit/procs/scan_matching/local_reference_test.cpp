// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/local_reference.hpp"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

/// A wall across x = `x_m`, hit at a height, that may be ground.
ScanObservation wall_ahead(double x_m, double z_m, bool may_be_ground) {
  std::vector<SurfacePoint> points;
  for (double y_m = -1.0; y_m <= 1.0; y_m += 0.05) {
    SurfacePoint point;
    point.p = {x_m, y_m};
    point.normal = {-1.0, 0.0};
    point.normal_variance = 1e-4;
    point.variance = 1e-4;
    point.z_m = z_m;
    if (may_be_ground) point.grade_group = 0;
    points.push_back(point);
  }
  const test::WallWorld tunnel = test::straight_tunnel(20.0, 3.0);
  const LaserScan scan = test::exact_scan(tunnel, {}, 0);
  return {LaserId::kFront, std::move(points), FreeSpace(scan, LaserMount{}, Attitude{}, 0.0), {}};
}

SurfacePoint point_at(double x_m) { return wall_ahead(x_m, 0.5, true).points[20]; }

bool has_surfel(const LocalReference& reference, double x_m) {
  return reference.surfels().nearest({x_m, 0.0}, {-1.0, 0.0}, 0.1).surfel != nullptr;
}

TEST(LocalReference, KeepsWhatMayBeGroundApartWhereThePlaceIsNotSure) {
  LocalReference reference{LocalReferenceParams{}};
  reference.add_keyframe(wall_ahead(5.0, 0.5, true), {}, 0.0, true);
  EXPECT_FALSE(has_surfel(reference, 5.0));
  reference.add_keyframe(wall_ahead(5.0, 0.5, false), {1.0, 0.0, 0.0}, 1.0, true);
  EXPECT_TRUE(has_surfel(reference, 6.0));  // this is a wall
  reference.add_keyframe(wall_ahead(5.0, 0.5, true), {2.0, 0.0, 0.0}, 2.0);
  EXPECT_TRUE(has_surfel(reference, 7.0));
}

/// Whether the heights come from scans that are drawn for matches or not.
TEST(LocalReference, KnowsAtWhichHeightsAWallWasSeen) {
  for (const bool first_apart : {true, false}) {
    for (const bool second_apart : {true, false}) {
      LocalReference reference{LocalReferenceParams{}};
      reference.add_keyframe(wall_ahead(5.0, 0.3, true), {}, 0.0, first_apart);
      EXPECT_FALSE(reference.is_steep_at(point_at(5.0), {}));
      reference.add_keyframe(wall_ahead(4.8, 0.9, true), {0.2, 0.0, 0.0}, 0.2, second_apart);
      EXPECT_TRUE(reference.is_steep_at(point_at(5.0), {})) << first_apart << second_apart;
      EXPECT_FALSE(reference.is_steep_at(point_at(9.0), {}));
    }
  }
}

}  // namespace
}  // namespace adit
