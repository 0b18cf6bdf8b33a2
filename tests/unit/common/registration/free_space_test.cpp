// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/free_space.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/worlds/crooked_room.hpp"

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

}  // namespace
}  // namespace adit
