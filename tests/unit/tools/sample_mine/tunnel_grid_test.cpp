// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/tunnel_grid.hpp"

#include <cmath>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "tools/sample_mine/sample_run.hpp"

namespace adit {
namespace {

TEST(TunnelGrid, CanBeDrivenWithRoomToSpare) {
  const SampleSite site = sample_site(SampleWorld::kLong, 1, 11'000.0);  // past a whole round
  for (const auto& [utime, pose] : drive_route(site.route, site.drive, 0)) {
    ASSERT_FALSE(site.mine.clearance(pose.translation(), 0.5)) << pose.x << ' ' << pose.y;
  }
}

TEST(TunnelGrid, IsClosed) {
  const SyntheticWorld mine = tunnel_grid(1);
  for (const Eigen::Vector2d& corner : tunnel_grid_route(5000.0)) {
    for (double angle = 0.0; angle < 6.28; angle += 0.1) {
      ASSERT_TRUE(mine.cast(corner, angle, 400.0)) << corner.transpose() << ' ' << angle;
    }
  }
}

TEST(TunnelGrid, ItsRouteIsAsLongAsItMustBe) {
  for (const double length : {100.0, 10'000.0, 30'000.0}) {
    double sum = 0.0;
    const auto route = tunnel_grid_route(length);
    for (std::size_t i = 1; i < route.size(); ++i) {
      const Eigen::Vector2d step = (route[i] - route[i - 1]).cwiseAbs();
      ASSERT_EQ(step.minCoeff(), 0.0);  // along a drift
      sum += step.sum();
    }
    EXPECT_GE(sum, length);
  }
}

TEST(TunnelGrid, ItsRouteComesByMostOfItMoreThanOnce) {
  const auto route = tunnel_grid_route(10'000.0);
  std::multiset<std::pair<int, int>> visits;
  for (const Eigen::Vector2d& corner : route) visits.insert({int(corner.x()), int(corner.y())});
  const std::set<std::pair<int, int>> places(visits.begin(), visits.end());
  EXPECT_EQ(places.size(), 72U);
  EXPECT_GT(visits.size(), 3 * places.size());
}

TEST(TunnelGrid, TheLongDriveHasAScanEveryTenthOfAMetre) {
  const SampleRun run(sample_site(SampleWorld::kLong, 1, 200.0), 1, {}, 200.0);
  EXPECT_NEAR(static_cast<double>(run.truth().size()), 2000.0, 3.0);
}

}  // namespace
}  // namespace adit
