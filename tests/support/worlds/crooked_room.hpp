// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/registration/surface_points.hpp"
#include "tools/sample_mine/synthetic_laser.hpp"
#include "tools/sample_mine/synthetic_world.hpp"

namespace adit::test {

/// A closed, crooked room of about 13 m by 9 m with a pillar: no two walls are parallel, so that a
/// scan of it leaves no direction open. The origin is inside.
SyntheticWorld crooked_room();

/// A laser that reads the truth.
SyntheticLaserModel perfect_laser();

/// The surface points that a laser at the origin of the body sees from a pose.
std::vector<SurfacePoint> scan_points(const SyntheticWorld& world, const Pose2& T_world_body,
                                      const SyntheticLaserModel& laser = perfect_laser(),
                                      std::uint64_t seed = 1);

}  // namespace adit::test
