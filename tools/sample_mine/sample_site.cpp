// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/sample_site.hpp"

#include "tools/sample_mine/mine_worlds.hpp"
#include "tools/sample_mine/parallel_mine.hpp"
#include "tools/sample_mine/tunnel_grid.hpp"

namespace adit {

SampleSite sample_site(SampleWorld world, std::uint64_t seed, double length_min_m) {
  DriveModel slow;
  slow.speed_m_s = 0.5;  // 0.1 m from scan to scan
  switch (world) {
    case SampleWorld::kParallel:
      return {parallel_mine(seed), parallel_mine_route(), {}, parallel_mine_odometry()};
    case SampleWorld::kLong:
      return {tunnel_grid(seed), tunnel_grid_route(length_min_m), slow, {}};
    case SampleWorld::kRing:
      break;
  }
  return {sample_mine(seed), sample_mine_route(), {}, {}};
}

}  // namespace adit
