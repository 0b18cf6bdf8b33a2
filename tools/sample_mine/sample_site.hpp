// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "tools/sample_mine/route_driver.hpp"
#include "tools/sample_mine/synthetic_odometry.hpp"
#include "tools/sample_mine/synthetic_world.hpp"

namespace adit {

/// A place, a way through it, and how a robot takes it.
struct SampleSite {
  SyntheticWorld mine;
  std::vector<Eigen::Vector2d> route;  ///< p_world [m]
  DriveModel drive;
  OdometryModel odometry;
};

enum class SampleWorld {
  kRing,      ///< sample_mine
  kParallel,  ///< parallel_mine
  kLong,      ///< tunnel_grid, with a scan every 0.1 m
};

/// `length_min_m` is for the long drive alone: the others have one length.
SampleSite sample_site(SampleWorld world, std::uint64_t seed, double length_min_m = 10'000.0);

}  // namespace adit
