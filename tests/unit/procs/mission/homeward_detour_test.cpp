// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/homeward_detour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

/// A drive along x, then to the left, 60 m in all.
TraversedPath bent_path() {
  TraversedPath path;
  std::int64_t utime = 0;
  for (double x = 0.0; x <= 30.0; x += 0.1) path.add(++utime, {x, 0.0, 0.0});
  for (double y = 0.0; y <= 30.0; y += 0.1) path.add(++utime, {30.0, y, std::numbers::pi / 2.0});
  return path;
}

TEST(HomewardDetour, IsTwiceAsLongEachTime) {
  const TraversedPath path = bent_path();
  HomewardDetour detour;
  std::vector<double> lengths_m;
  for (int blocked = 1; blocked <= 9; ++blocked) {
    detour.note_blocked(path);
    if (detour.is_active()) lengths_m.push_back(detour.left_m(path));
    detour.end();
  }
  ASSERT_EQ(lengths_m.size(), 4U);
  EXPECT_NEAR(lengths_m[0], 12.0, 1e-9);
  EXPECT_NEAR(lengths_m[1], 24.0, 1e-9);
  EXPECT_NEAR(lengths_m[2], 48.0, 1e-9);
  EXPECT_NEAR(lengths_m[3], 60.0, 0.5);  // back to the start
}

TEST(HomewardDetour, LeadsBackAlongTheTraversedPath) {
  TraversedPath path = bent_path();
  HomewardDetour detour;
  for (int blocked = 0; blocked < 7; ++blocked) detour.note_blocked(path);
  const auto route = detour.route_odom(path);
  ASSERT_TRUE(route);
  EXPECT_NEAR((route->front() - Eigen::Vector2d(30.0, 30.0)).norm(), 0.0, 0.2);
  EXPECT_NEAR((route->back() - Eigen::Vector2d(20.0, 0.0)).norm(), 0.0, 1.0);  // 40 m
  for (const Eigen::Vector2d& p : *route)
    EXPECT_LT(std::min(std::abs(p.y()), std::abs(p.x() - 30.0)), 0.01) << p.transpose();
  // Driven back the path gets shorter, and the detour is done where it was to end.
  for (double y = 30.0; y >= 0.0; y -= 0.1) path.add(0, {30.0, y, std::numbers::pi / 2.0});
  EXPECT_NEAR(detour.left_m(path), 18.0, 1.0);
  for (double x = 30.0; x >= 11.0; x -= 0.1) path.add(0, {x, 0.0, 0.0});
  EXPECT_FALSE(detour.route_odom(path));
}

TEST(HomewardDetour, CutsTheTurnsOfTheTraversedPath) {
  TraversedPath path;
  for (double x = 0.0; x <= 10.0; x += 0.1) path.add(0, {x, 0.0, 0.0});
  for (int i = 0; i <= 10; ++i) path.add(0, {10.0 - 0.05 * i, 0.0, 0.1 * i});  // a three-point turn
  for (int i = 0; i <= 10; ++i) path.add(0, {9.5 + 0.05 * i, 0.1, 1.0 + 0.1 * i});
  for (double x = 10.0; x <= 20.0; x += 0.1) path.add(0, {x, 0.1, 0.0});
  HomewardDetour detour;
  for (int blocked = 0; blocked < 5; ++blocked) detour.note_blocked(path);
  const auto route = detour.route_odom(path);
  ASSERT_TRUE(route);
  for (std::size_t i = 1; i < route->size(); ++i)
    EXPECT_LT((*route)[i].x(), (*route)[i - 1].x()) << i;
}

class MissionOnADetour : public ScriptedStages {
 protected:
  /// 30 m into the mine; the route home of exploration is elsewhere.
  void SetUp() override {
    to_execute();
    drive(30.0);
    arrive();
    reach_m_ = 10.0;
  }
  /// Until exploration is asked again, with a verdict.
  void block_route_home() {
    for (int i = 0; i < 10; ++i) {
      if (now() == Phase::kExplore) answer(Kind::kHome);
      if (now() == Phase::kScan) terrain();
      if (now() == Phase::kPlan) path(PlanOutcome::kBlocked);
      if (now() == Phase::kExplore && request_.blocked) break;
    }
    ASSERT_TRUE(request_.blocked);
    detour_length_m_ += 2.0;  // the next route leads round the place
  }
};

TEST_F(MissionOnADetour, FollowsTheTraversedPathAfterThreeBlockedRoutesHome) {
  for (int blocked = 0; blocked < 3; ++blocked) block_route_home();
  answer(Kind::kHome);
  EXPECT_THAT(phase().reason, testing::HasSubstr("12 m along the traversed path"));
  if (now() == Phase::kScan) terrain();
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_LT(goal_.route_odom.back().x(), x_m_ - 8.0);
}

TEST_F(MissionOnADetour, GivesNoVerdictOnARouteThatIsNotOfExploration) {
  for (int blocked = 0; blocked < 3; ++blocked) block_route_home();
  for (int i = 0; i < 20 && !phase().reason.starts_with("the traversed path is blocked"); ++i) {
    if (now() == Phase::kExplore) answer(Kind::kHome);
    if (now() == Phase::kScan) terrain();
    if (now() == Phase::kPlan) path(PlanOutcome::kBlocked);
    ASSERT_FALSE(now() == Phase::kExplore && request_.blocked) << phase().reason;
  }
  EXPECT_THAT(phase().reason, testing::StartsWith("the traversed path is blocked too"));
}

}  // namespace
}  // namespace adit
