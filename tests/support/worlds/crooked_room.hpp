// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/registration/surface_points.hpp"
#include "common/sensing/laser_scan.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit::test {

/// A closed, irregular room of about 13 m by 9 m with a pillar. No two walls are parallel, so that
/// a scan constrains all directions. The origin is inside.
WallWorld crooked_room();

/// The surface points of a scan whose laser is at the origin of the body.
std::vector<SurfacePoint> scan_points(const LaserScan& scan);
/// The surface points of an exact scan.
std::vector<SurfacePoint> scan_points(const WallWorld& world, const Pose2& T_world_body);

}  // namespace adit::test
