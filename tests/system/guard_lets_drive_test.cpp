// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The guard does not stop the robot without a reason.
#include <gtest/gtest.h>

#include "procs/scan_matching/scan_matching_node.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_description.hpp"
#include "tests/support/robots/simulated_robot.hpp"
#include "tests/support/worlds/box_tunnel.hpp"
#include "tests/system/guarded_robot.hpp"

namespace adit {
namespace {

constexpr BoxTunnel kNarrow{40.0, 1.8, 2.0};  // 0.3 m on either side of the vehicle

/// Distance driven in twenty seconds, which must be without a stop.
double distance_without_stop_m(World world, double speed_m_s) {
  GuardedRobot robot(std::move(world));
  robot.drive(speed_m_s);
  robot.run(20.0);
  EXPECT_EQ(robot.failure(), "");
  EXPECT_FALSE(robot.order().stopped) << robot.order().reason;
  EXPECT_EQ(robot.stops(), 0);
  return std::abs(robot.motion().T_world_body.translation().x());
}

TEST(GuardLetsDrive, InANarrowTunnel) {
  EXPECT_GT(distance_without_stop_m(box_tunnel(kNarrow), 0.5),
            8.5);  // 10 m less slip, release time and acceleration
  EXPECT_GT(distance_without_stop_m(box_tunnel(kNarrow), -0.5), 8.5);
}

TEST(GuardLetsDrive, OverRails) {
  const auto rails = [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kRail, Material::kSteel, "rails");
    for (const double x : {2.0, 3.1, 5.0, 5.8, 8.0}) {
      builder.box(level_box({x, 0.0, 0.06}, {0.07, 1.8, 0.12}));
    }
  };
  EXPECT_GT(distance_without_stop_m(box_tunnel(kNarrow, rails), 0.5), 8.5);
  EXPECT_GT(distance_without_stop_m(box_tunnel(kNarrow, rails), 0.2), 3.0);
}

World rough_tunnel() {
  WorldDescription rough;  // relief of the walls 0.12 m to either side
  rough.name = "rough";
  rough.T_world_start = {5.0, 0.0, 0.0};
  rough.plan.tunnels.push_back({"tunnel", {0.0, 0.0, 40.0, 0.0}, 2.4});
  rough.heights.floor_relief = {.height_m = 0.06, .length_m = 1.0};
  return build_world(rough);
}

TEST(GuardLetsDrive, OverRoughGround) {
  EXPECT_GT(distance_without_stop_m(rough_tunnel(), 0.5), 5.0 + 8.0);  // start at x = 5
}

TEST(GuardLetsDrive, WithPosesOfScanMatching) {
  GuardedRobot robot(rough_tunnel());
  const ScanMatchingNode scan_matching(robot.bus(), with_groundhog_lasers<ScanMatchingParams>());
  robot.stop_localization();
  robot.drive(0.5);
  robot.run(15.0);
  EXPECT_FALSE(robot.order().stopped) << robot.order().reason;
  EXPECT_EQ(robot.stops(), 0);
  EXPECT_GT(robot.distance_travelled_m(), 5.0);
}

TEST(GuardLetsDrive, UpAndDownASlope) {
  const auto hump = [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kOther, Material::kRock, "hump");
    const auto corner = [&](double x, double y, double z) {
      return builder.vertex(Eigen::Vector3d(x, y, z).cast<float>());
    };
    const auto slope = [&](double from_x, double from_z, double to_x, double to_z) {
      builder.quad(corner(from_x, -0.9, from_z), corner(to_x, -0.9, to_z), corner(to_x, 0.9, to_z),
                   corner(from_x, 0.9, from_z));
    };
    slope(2.0, 0.0, 5.0, 0.6);
    slope(5.0, 0.6, 8.0, 0.0);
  };
  EXPECT_GT(distance_without_stop_m(box_tunnel({40.0, 1.8, 3.0}, hump), 0.5), 8.5);
}

TEST(GuardLetsDrive, OutOfADeadEndInReverse) {
  GuardedRobot robot(box_tunnel({8.0, 1.8, 2.0}));
  robot.drive(0.4);
  robot.run(15.0);
  EXPECT_TRUE(robot.order().stopped);
  const double x_stop = robot.motion().T_world_body.translation().x();
  robot.drive(-0.4);
  robot.run(5.0);
  EXPECT_FALSE(robot.order().stopped) << robot.order().reason;
  EXPECT_LT(robot.motion().T_world_body.translation().x(), x_stop - 1.0);
}

}  // namespace
}  // namespace adit
