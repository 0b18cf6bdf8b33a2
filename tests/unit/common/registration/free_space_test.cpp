// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/free_space.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

constexpr double kMargin = 0.2;

LaserScan scan_at(const Pose2& T_world_laser) {
  return test::exact_scan(test::crooked_room(), T_world_laser, 1'000'000);
}

TEST(FreeSpace, ContainsNoPointOfAnotherScanOfTheSamePlace) {
  const Pose2 a{-2.0, 0.0, 0.1};
  const Pose2 b{-1.5, 0.3, 0.6};
  const FreeSpace space(scan_at(a), LaserMount{});
  EXPECT_EQ(space.count_inside(test::scan_points(test::crooked_room(), b), between(a, b), kMargin),
            0);
}

TEST(FreeSpace, ContainsManyPointsOfAMisplacedScan) {
  const Pose2 a{-2.0, 0.0, 0.1};
  const FreeSpace space(scan_at(a), LaserMount{});
  const auto points = test::scan_points(test::crooked_room(), a);
  EXPECT_GT(space.count_inside(points, {-1.0, 0.0, 0.0}, kMargin), 50);
}

TEST(FreeSpace, IsUnknownForBeamsWithoutReturn) {
  LaserScan scan{1'000'000, std::vector<float>(181, 81.83F), -std::numbers::pi / 2,
                 std::numbers::pi / 180};
  const FreeSpace space(scan, LaserMount{});
  EXPECT_EQ(space.count_inside(test::scan_points(test::crooked_room(), {}), {}, kMargin), 0);
}

TEST(FreeSpace, IsEmptyWithoutAScan) {
  EXPECT_EQ(FreeSpace().count_inside(test::scan_points(test::crooked_room(), {}), {}, kMargin), 0);
}

TEST(FreeSpace, IsNoneAboveAndBelowTheBeams) {
  LaserScan scan;
  scan.angle_min_rad = -0.1;
  scan.angle_step_rad = 0.05;
  scan.ranges_m = {10.0F, 10.0F, 10.0F, 10.0F, 10.0F};
  LaserMount mount;
  mount.height_m = 0.6;
  const Attitude raised{0.0, -0.2};  // the beams rise by 0.2 m per metre
  const FreeSpace space(scan, mount, raised, 3.0);
  EXPECT_TRUE(space.inside({5.0, 0.0}, 3.6 + 5.0 * std::tan(0.2), kMargin));
  EXPECT_FALSE(space.inside({5.0, 0.0}, 3.6, kMargin));
  EXPECT_TRUE(FreeSpace(scan, mount).inside({5.0, 0.0}, 0.6, kMargin));
}

}  // namespace
}  // namespace adit
