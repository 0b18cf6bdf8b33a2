// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/local_walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

#include "tests/unit/procs/mapping/mapped_world.hpp"

namespace adit {
namespace {

TEST(LocalWalls, LieOnTheWallsThinnedOut) {
  const test::WallWorld room = test::crooked_room();
  const Pose2 T_world_local{-3.0, 0.0, 0.3};
  const LocalWallsParams params;
  const LocalWalls walls = test::walls_of(room, T_world_local, 3.0);
  EXPECT_GT(walls.length_m, 15.0);  // the walls of the room are 40 m, half of them visible
  EXPECT_LT(walls.points.size(), 60.0 / params.spacing_m);
  for (const auto& point : walls.points) {
    const auto clearance = room.clearance(T_world_local * point.p, 1.0);
    ASSERT_TRUE(clearance);
    EXPECT_LT(*clearance, 0.05);  // 5 sigma of a single reading
    EXPECT_GE(point.variance, params.wall_sd_m * params.wall_sd_m);
  }
}

TEST(LocalWalls, StoreFewViewsOfTheFreeSpace) {
  const LocalMap map = test::drive_straight(test::crooked_room(), {-3.0, 0.0, 0.0}, 3.0, 1);
  const LocalWalls walls = local_walls(map, test::front_mount(), {});
  EXPECT_GE(walls.views.size(), 3U);  // about one per metre
  EXPECT_LE(walls.views.size(), 4U);
}

TEST(LocalWalls, LeaveOutUnconfirmedBeams) {
  // The end of the tunnel may be rising ground: all beams to it are unconfirmed.
  const test::WallWorld tunnel(
      {{{-20.0, 1.5}, {10.0, 1.5}}, {{-20.0, -1.5}, {10.0, -1.5}}, {{10.0, -1.5}, {10.0, 1.5}}});
  constexpr double kEndM = 9.5;  // corners are left out with the end
  const auto at_end = [](const LocalWalls& walls) {
    return std::ranges::count_if(walls.points,
                                 [](const auto& point) { return point.p.x() > kEndM; });
  };
  const auto along = [](const LocalWalls& walls) {
    return std::ranges::count_if(walls.points,
                                 [](const auto& point) { return point.p.x() < kEndM; });
  };
  LocalMap map = test::drive_straight(tunnel, {}, 5.0, 1);
  const LocalWalls all = local_walls(map, test::front_mount(), {});
  EXPECT_GT(at_end(all), 10);
  for (LocalScan& local : map.scans) {
    for (std::size_t i = 0; i < local.scan.ranges_m.size(); ++i) {
      const double bearing =
          local.scan.angle_min_rad + static_cast<double>(i) * local.scan.angle_step_rad;
      const double x_m = local.T_local_body.x + local.scan.ranges_m[i] * std::cos(bearing);
      if (x_m > kEndM) local.unconfirmed_beams.push_back(static_cast<std::int32_t>(i));
    }
  }
  const LocalWalls confirmed = local_walls(map, test::front_mount(), {});
  EXPECT_EQ(at_end(confirmed), 0);
  EXPECT_EQ(along(confirmed), along(all));
}

TEST(LocalWalls, IgnoreScansWithoutAMount) {
  LocalMap map = test::drive_straight(test::crooked_room(), {-3.0, 0.0, 0.0}, 1.0, 1);
  for (auto& scan : map.scans) scan.channel = "LASER_ELSEWHERE";
  const LocalWalls walls = local_walls(map, test::front_mount(), {});
  EXPECT_TRUE(walls.points.empty());
  EXPECT_TRUE(walls.views.empty());
}

/// Both walls of a tunnel along x, seen from inside, `half_m` from its axis.
std::vector<SurfacePoint> tunnel_walls(double half_m) {
  std::vector<SurfacePoint> points;
  for (double x = -3.0; x < 3.0; x += 0.1) {
    for (const double side : {-1.0, 1.0}) {
      SurfacePoint point;
      point.p = {x, side * half_m};
      point.normal = {0.0, -side};
      points.push_back(point);
    }
  }
  return points;
}

TEST(DistancesBeforeWalls, AreThoseTowardsWhereTheWallsWereSeenFrom) {
  SurfelMap reference(SurfelMapParams{});
  reference.insert(tunnel_walls(1.5), {}, 0.0);
  // Narrower by 3 cm on each side, as with a laser whose ranges are too short, and the other one.
  for (const double before_m : distances_before_walls(tunnel_walls(1.47), {}, reference, 0.5))
    EXPECT_NEAR(before_m, 0.03, 1e-6);
  for (const double before_m : distances_before_walls(tunnel_walls(1.52), {}, reference, 0.5))
    EXPECT_NEAR(before_m, -0.02, 1e-6);
  const auto aside = distances_before_walls(tunnel_walls(1.5), {0.0, 0.1, 0.0}, reference, 0.5);
  ASSERT_EQ(aside.size(), 120U);
  for (std::size_t i = 0; i < aside.size(); ++i)
    EXPECT_NEAR(aside[i], i % 2 == 0 ? 0.1 : -0.1, 1e-6);
  EXPECT_TRUE(distances_before_walls(tunnel_walls(0.5), {}, reference, 0.5).empty());
}

}  // namespace
namespace {

class RoomAgreement : public testing::Test {
 protected:
  RoomAgreement() { reference_.insert(walls_.points, {}, 0.0); }

  [[nodiscard]] WallAgreement at(const Pose2& T_reference_points) const {
    return agreement(walls_.points, T_reference_points, reference_, walls_.views, {});
  }

  LocalWalls walls_ = test::walls_of(test::crooked_room(), {-3.0, 0.0, 0.0}, 3.0);
  SurfelMap reference_{SurfelMapParams{}};
};

TEST_F(RoomAgreement, OfAMapWithItselfIsComplete) {
  const WallAgreement found = at({});
  EXPECT_EQ(found.near, found.points);
  EXPECT_EQ(found.contradicting, 0);
  EXPECT_GT(found.log_likelihood, 2.0 * found.points);
}

TEST_F(RoomAgreement, IsContradictedByWallsInFreeSpace) {
  const WallAgreement found = at({0.0, 0.0, 1.0});
  EXPECT_GT(found.contradicting, found.points / 6);
  EXPECT_LT(found.log_likelihood, 0.0);
}

TEST_F(RoomAgreement, FallsWithTheDistanceFromTheTruth) {
  double last = at({}).log_likelihood;
  for (const double off : {0.05, 0.1, 0.2, 0.4}) {
    const double here = at({off, off, 0.0}).log_likelihood;
    EXPECT_LT(here, last) << off;
    last = here;
  }
}

TEST_F(RoomAgreement, IgnoresUnobservedSpace) {
  const WallAgreement found = at({200.0, 0.0, 0.0});
  EXPECT_EQ(found.observed(), 0);
  EXPECT_EQ(found.log_likelihood, 0.0);
}

}  // namespace
}  // namespace adit
