// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Cases in which memory must not be used, and its bounds.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/procs/terrain/terrain_scenes.hpp"

namespace adit {
namespace {

const Pose2 kFirst{-6.0, 0.0, 0.0};
const Pose2 kBefore{-6.5, 0.0, 0.0};
const Pose2 kHere{0.0, 0.0, 0.0};
const Eigen::AlignedBox2d kBeside(Eigen::Vector2d(-2.0, 0.8), Eigen::Vector2d(1.5, 1.5));

bool is_seen(const TerrainCell& cell) { return cell.ground == Ground::kObserved; }

TEST(TerrainMemoryLimits, ScansFromAfarAreDiscarded) {
  for (const double farther_m : {0.0, 10.0}) {
    ScanningVehicle vehicle({-6.0 - farther_m, 0.0, 0.0});
    vehicle.scan(add_tunnel);
    vehicle.drive_to(kHere);
    vehicle.scan(add_tunnel);
    EXPECT_EQ(vehicle.memory().recall_result().used, farther_m < 1.0 ? 1 : 0) << farther_m;
  }
}

/// Driving to and fro takes the robot over 15 m of path, yet it is still on the same level.
TEST(TerrainMemoryLimits, ToAndFroRemembersUntilOdomHasDrifted) {
  for (const double detour_m : {3.0, 6.0, 12.0, 18.0}) {
    ScanningVehicle vehicle(kFirst);
    vehicle.scan(add_tunnel);
    vehicle.drive_to({detour_m, 0.0, 0.0});
    vehicle.drive_to(kHere);  // 12 m to 42 m after the scan
    const TerrainMap map = vehicle.scan(add_tunnel);
    EXPECT_EQ(share_of(map, kBeside, is_seen), detour_m < 17.0 ? 1.0 : 0.0) << detour_m;
  }
}

/// Mapping places in map what was seen long ago: odom may drift. Not where map itself is less sure
/// of the place than before, or has become surer of it by a loop closure.
TEST(TerrainMemoryLimits, RemembersWhatMapHasPlacedSince) {
  struct Case {
    bool with_map;
    double sd_then_m, sd_now_m;
    bool is_used;
  };
  for (const Case& c :
       {Case{false, 0.0, 0.0, false}, Case{true, 0.0, 0.0, true}, Case{true, 0.2, 0.205, true},
        Case{true, 0.1, 0.15, false}, Case{true, 0.15, 0.1, false}}) {
    ScanningVehicle vehicle(kBefore);
    if (c.with_map) vehicle.memory().correct({}, c.sd_then_m * c.sd_then_m);
    vehicle.drive_to(kFirst);
    vehicle.scan(add_tunnel);
    for (const double x_m : {20.0, 40.0, 60.0, 40.0, 20.0, 0.0}) {
      vehicle.drive_to({x_m, 0.0, 0.0});
      if (c.with_map) vehicle.memory().correct({}, c.sd_now_m * c.sd_now_m);
    }
    const TerrainMap map = vehicle.scan(add_tunnel);
    EXPECT_EQ(vehicle.memory().recall_result().used, c.is_used ? 1 : 0);
    EXPECT_EQ(share_of(map, kBeside, is_seen), c.is_used ? 1.0 : 0.0);
  }
}

/// Where odom has drifted between a scan and now, a correction moves the scan in odom, but not what
/// the newest local maps hold.
TEST(TerrainMemoryLimits, AMapCorrectionMovesOldScans) {
  const Pose2 drift{0.0, 0.5, 0.0};
  for (const bool is_old : {false, true}) {
    ScanningVehicle vehicle(kFirst);
    vehicle.scan(add_tunnel, false, 0.0, drift);
    if (is_old) vehicle.drive_to({12.0, 0.0, 0.0});
    vehicle.drive_to(kHere);
    vehicle.memory().correct(drift.inverse(), 0.0);
    vehicle.scan(add_tunnel);
    EXPECT_EQ(vehicle.memory().recall_result().used, is_old ? 1 : 0);
    EXPECT_EQ(vehicle.memory().recall_result().rejected, is_old ? 0 : 1);
  }
}

/// A circle of 20 m ends where it began in plan, and may have led to another level.
TEST(TerrainMemoryLimits, AFullCircleMayLeadToAnotherLevel) {
  ScanningVehicle vehicle(kHere);
  vehicle.scan(add_tunnel);
  const double radius_m = 20.0 / (2.0 * std::numbers::pi);
  for (int i = 1; i <= 72; ++i) {
    const double turned = 2.0 * std::numbers::pi * i / 72.0;
    vehicle.drive_to({radius_m * std::sin(turned), radius_m * (1.0 - std::cos(turned)), turned});
  }
  vehicle.scan(add_tunnel);
  EXPECT_EQ(vehicle.memory().recall_result().used, 0);
}

TEST(TerrainMemoryLimits, LimitsTheNumberOfMaps) {
  TerrainParams params;
  params.memory.maps_max = 2;
  ScanningVehicle vehicle(kHere, params);
  for (int i = 0; i < 4; ++i) {
    vehicle.scan(add_tunnel);
    EXPECT_EQ(vehicle.memory().maps(), std::min<std::size_t>(static_cast<std::size_t>(i) + 1, 2));
  }
}

TEST(TerrainMemoryLimits, StoresNoMapsIfDisabled) {
  TerrainParams params;
  params.memory.maps_max = 0;
  ScanningVehicle vehicle(kFirst, params);
  vehicle.scan(add_tunnel);
  vehicle.drive_to(kHere);
  EXPECT_EQ(share_of(vehicle.scan(add_tunnel), kBeside, is_seen), 0.0);
}

TEST(TerrainMemoryLimits, AJumpOfOdomClearsIt) {
  ScanningVehicle vehicle(kFirst);
  vehicle.scan(add_tunnel);
  vehicle.drive_to(kHere);
  vehicle.memory().add(1'600'000'030'000'000, {90.0, 0.0, 0.0});
  EXPECT_EQ(vehicle.memory().maps(), 0U);
}

TEST(TerrainMemoryLimits, ItResumesInANewOdomFrameThatIsAnchored) {
  const Pose2 T_new_old{90.0, -4.0, 2.0};
  const auto rescan = [&](bool anchored) {
    ScanningVehicle vehicle(kFirst);
    vehicle.scan(add_tunnel);
    vehicle.drive_to(kHere);
    vehicle.memory().add(1'600'000'030'000'000, T_new_old * kHere);
    EXPECT_EQ(vehicle.memory().maps(), 0U);
    if (anchored) vehicle.memory().anchor(T_new_old);
    const TerrainMap map = vehicle.scan(add_tunnel, false, 0.0, T_new_old);
    EXPECT_EQ(vehicle.memory().recall_result().used, anchored ? 1 : 0);
    return share_of(map, kBeside, is_seen);
  };
  EXPECT_EQ(rescan(true), 1.0);
  EXPECT_EQ(rescan(false), 0.0);
}

TEST(TerrainMemoryLimits, ANewOdomFrameWithoutAJumpClearsIt) {
  ScanningVehicle vehicle(kFirst);
  vehicle.scan(add_tunnel);
  vehicle.drive_to(kHere);
  const std::int64_t odom_epoch_utime = 1'600'000'030'000'000;
  vehicle.memory().add(odom_epoch_utime, {0.3, 0.0, 0.0});
  EXPECT_EQ(vehicle.memory().maps(), 1U);
  vehicle.memory().reset(odom_epoch_utime);
  EXPECT_EQ(vehicle.memory().maps(), 0U);
  vehicle.memory().anchor({0.3, 0.0, 0.0});
  EXPECT_EQ(vehicle.memory().maps(), 1U);
}

TEST(TerrainMemoryLimits, AScanWithMovedWallsIsRejected) {
  for (const Pose2& wrong : {Pose2{0.0, 0.5, 0.0}, Pose2{0.0, 0.0, 0.1}}) {
    ScanningVehicle vehicle(kFirst);
    vehicle.scan(add_tunnel, false, 0.0, wrong);
    vehicle.drive_to(kHere);
    const TerrainMap map = vehicle.scan(add_tunnel);
    EXPECT_EQ(vehicle.memory().recall_result().rejected, 1);
    EXPECT_EQ(share_of(map, kBeside, is_seen), 0.0);
  }
}

TEST(TerrainMemoryLimits, AScanWithDifferentGroundIsRejected) {
  const auto ramp = [](MeshBuilder& builder) {  // a level with an error of 10 degrees
    const auto corner = [&](float x, float y) {
      return builder.vertex({x, y, 0.18F * (x + 6.0F)});
    };
    builder.quad(corner(-15, -2), corner(15, -2), corner(15, 2), corner(-15, 2));
  };
  ScanningVehicle vehicle(kFirst);
  vehicle.scan(ramp);
  vehicle.drive_to(kHere);
  const auto flat = [](MeshBuilder& builder) { add_ground(builder, -15.0, 15.0); };
  vehicle.scan(flat);
  EXPECT_EQ(vehicle.memory().recall_result().rejected, 1);
}

}  // namespace
}  // namespace adit
