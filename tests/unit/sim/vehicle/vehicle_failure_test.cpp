// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <functional>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/robots/chamfered_vehicle.hpp"
#include "tests/unit/sim/vehicle/driving.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A tunnel with one object.
World tunnel_with(PartKind kind, const char* name, const std::function<void(MeshBuilder&)>& add) {
  return box_tunnel({}, [&](MeshBuilder& builder) {
    builder.begin_part(kind, Material::kRock, name);
    add(builder);
  });
}

World with_box(const char* name, const Eigen::Vector3d& middle, const Eigen::Vector3d& size) {
  return tunnel_with(PartKind::kOther, name,
                     [&](MeshBuilder& builder) { builder.box(level_box(middle, size)); });
}

World with_post() {
  return tunnel_with(PartKind::kPost, "post", [](MeshBuilder& builder) {
    builder.bar({5.0, 0.3, 0.0}, {5.0, 0.3, 2.0}, 0.1);
  });
}

/// A floor of sections along x, 4 m wide, each at its height.
struct Stretch {
  double from_m;
  double to_m;
  double z_m;
};
World with_floor(const std::vector<Stretch>& stretches) {
  MeshBuilder builder;
  builder.begin_part(PartKind::kFloor, Material::kRock, "floor");
  for (const auto& [from, to, z] : stretches) {
    const auto corner = [&, z_m = z](double x, double y) {
      return builder.vertex(Eigen::Vector3d(x, y, z_m).cast<float>());
    };
    builder.quad(corner(from, -2.0), corner(to, -2.0), corner(to, 2.0), corner(from, 2.0));
  }
  World world;
  world.mesh = builder.take();
  return world;
}

/// Standing water from x = 3 m on, with its surface in the mesh.
World with_water(double level_m) {
  World world = box_tunnel({}, [&](MeshBuilder& builder) {
    builder.begin_part(PartKind::kWater, Material::kWater, "sump");
    const auto corner = [&](double x, double y) {
      return builder.vertex(Eigen::Vector3d(x, y, level_m).cast<float>());
    };
    builder.quad(corner(3.0, -2.0), corner(10.0, -2.0), corner(10.0, 2.0), corner(3.0, 2.0));
  });
  world.water.push_back({"sump", {{3.0, -2.0}, {10.0, -2.0}, {10.0, 2.0}, {3.0, 2.0}}, level_m});
  return world;
}

TEST(VehicleFailure, APostStopsItAtItsFront) {
  const Site site(with_post());
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  drive(vehicle, 0.5, 0.0, 30.0);
  ASSERT_TRUE(vehicle.failure());
  EXPECT_THAT(*vehicle.failure(), StartsWith("collision with 'post' after 3.7"));
  // The post begins at 4.9 m and the vehicle's front is at 1.2 m; collisions are checked every 4
  // cm, and a step is 5 mm.
  EXPECT_NEAR(vehicle.distance_travelled_m(), 3.7 + 0.0225, 0.0225);
}

/// The post is 0.1 m inside the flank: there the edge of a corner cut by 0.4 m is 0.3 m behind the
/// front.
TEST(VehicleFailure, APostMeetsACutCornerBehindTheFront) {
  const auto travelled_m = [](const Vehicle& dimensions) {
    const Site site(tunnel_with(PartKind::kPost, "post", [](MeshBuilder& builder) {
      builder.bar({5.0, 0.5, 0.0}, {5.0, 0.5, 2.0}, 0.01);
    }));
    VehicleModel vehicle(site, dimensions, without_slip(), 1, 0);
    drive(vehicle, 0.5, 0.0, 30.0);
    EXPECT_THAT(vehicle.failure().value_or("none"), StartsWith("collision with 'post'"));
    return vehicle.distance_travelled_m();
  };
  EXPECT_NEAR(travelled_m({}), 3.8, 0.05);
  EXPECT_NEAR(travelled_m(chamfered({}, 0.4)), 3.8 + 0.3, 0.05);
}

TEST(VehicleFailure, IsPermanent) {
  const Site site(with_post());
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  drive(vehicle, 0.5, 0.0, 30.0);
  const BodyMotion stood = vehicle.motion();
  const auto reason = vehicle.failure();
  for (int i = 0; i < 100; ++i) {
    vehicle.command(DriveCommand{vehicle.motion().utime, -0.5, 0.0});
    vehicle.advance(kStepS);
  }
  EXPECT_EQ(vehicle.failure(), reason);
  EXPECT_EQ(vehicle.motion().T_world_body.matrix(), stood.T_world_body.matrix());
  EXPECT_EQ(vehicle.motion().v_body.norm(), 0.0);
  EXPECT_EQ(vehicle.state().speed_m_s, 0.0);
  EXPECT_EQ(vehicle.motion().utime, stood.utime + 1'000'000);
}

TEST(VehicleFailure, ACableAcrossThePathIsACollision) {
  const auto cable = [](double z) {
    return tunnel_with(PartKind::kCable, "cable", [z](MeshBuilder& builder) {
      builder.bar({5.0, -2.0, z}, {5.0, 2.0, z}, 0.015);
    });
  };
  EXPECT_THAT(failure_ahead(cable(0.8)), StartsWith("collision with 'cable' after 3.8"));
  EXPECT_EQ(failure_ahead(cable(1.1)), "none");
}

TEST(VehicleFailure, ALowRoofIsACollisionAndAHigherOneIsNot) {
  EXPECT_THAT(failure_ahead(with_box("low_roof", {6.0, 0.0, 1.9}, {2.0, 4.0, 2.0})),
              HasSubstr("collision with 'low_roof'"));
  EXPECT_EQ(failure_ahead(with_box("low_roof", {6.0, 0.0, 2.05}, {2.0, 4.0, 2.0})), "none");
}

TEST(VehicleFailure, AWallIsACollision) {
  EXPECT_THAT(failure_ahead(box_tunnel({20.0, 4.0, 2.0})), StartsWith("collision with 'walls'"));
}

TEST(VehicleFailure, AStoneHigherThanTheBellyIsACollision) {
  EXPECT_THAT(failure_ahead(with_box("stone", {5.0, 0.0, 0.2}, {0.3, 0.3, 0.4})),
              HasSubstr("collision with 'stone'"));
  EXPECT_EQ(failure_ahead(with_box("stone", {5.0, 0.0, 0.1}, {0.3, 0.3, 0.2})), "none");
}

TEST(VehicleFailure, AStumpBelowTheBellyIsAStepForAWheel) {
  EXPECT_THAT(failure_ahead(with_box("stump", {5.0, 0.475, 0.14}, {0.15, 0.15, 0.28})),
              StartsWith("front left wheel at a step of 0.28 m of 'stump' after 3.9"));
  EXPECT_EQ(failure_ahead(with_box("stump", {5.0, 0.0, 0.14}, {0.15, 0.15, 0.28})), "none");
}

TEST(VehicleFailure, AStepThatIsTooHighUpOrDown) {
  EXPECT_THAT(failure_ahead(with_box("ledge", {10.0, 0.0, 0.0}, {10.0, 4.0, 0.5})),
              HasSubstr("wheel at a step of 0.25 m of 'ledge'"));
  EXPECT_THAT(failure_ahead(with_floor({{-20.0, 5.0, 0.0}, {5.0, 20.0, -0.25}})),
              HasSubstr("wheel at a step of 0.25 m of 'floor'"));
}

/// A level floor up to x = 4 m, and from there a ramp.
World with_ramp(double slope) {
  return tunnel_with(PartKind::kOther, "ramp", [slope](MeshBuilder& builder) {
    const float rise = static_cast<float>(4.0 * std::tan(slope));
    const auto corner = [&](float x, float y, float z) { return builder.vertex({x, y, z}); };
    builder.quad(corner(4.0F, -2.0F, 0.0F), corner(8.0F, -2.0F, rise), corner(8.0F, 2.0F, rise),
                 corner(4.0F, 2.0F, 0.0F));
  });
}

TEST(VehicleFailure, TipsOverWhereItIsTooSteep) {
  EXPECT_THAT(failure_ahead(with_ramp(0.4), 10.0), HasSubstr("none"));
  World steep = with_ramp(0.6);
  Vehicle high;
  high.belly_clearance_m = 0.6;  // so that its front passes over the foot of the ramp
  const Site site(std::move(steep));
  VehicleModel vehicle(site, high, without_slip(), 1, 0);
  drive(vehicle, 0.5, 0.0, 20.0);
  EXPECT_THAT(vehicle.failure().value_or("none"),
              StartsWith("tips over at a pitch of 29 degrees after"));  // 0.5 rad
}

TEST(VehicleFailure, AStepBelowTheLimitIsClimbed) {
  EXPECT_EQ(failure_ahead(with_box("ledge", {10.0, 0.0, 0.0}, {10.0, 4.0, 0.3})), "none");
  EXPECT_EQ(failure_ahead(with_floor({{-20.0, 5.0, 0.0}, {5.0, 20.0, -0.15}})), "none");
}

TEST(VehicleFailure, APitWithAndWithoutABottom) {
  EXPECT_THAT(failure_ahead(with_floor({{-20.0, 5.0, 0.0}, {5.0, 7.0, -1.0}, {7.0, 20.0, 0.0}})),
              HasSubstr("at a step of 1.00 m"));
  EXPECT_THAT(failure_ahead(with_floor({{-20.0, 5.0, 0.0}, {7.0, 20.0, 0.0}})),
              StartsWith("no ground under the front left wheel after 4.2"));
}

TEST(VehicleFailure, DeepWaterIsAFailureAndShallowWaterIsNot) {
  EXPECT_THAT(failure_ahead(with_water(0.3)), StartsWith("in water 'sump' of 0.30 m after 3.0"));
  EXPECT_EQ(failure_ahead(with_water(0.2)), "none");
}

TEST(VehicleFailure, StuckInMud) {
  World world = box_tunnel();
  world.soft_ground.push_back({"mud", {4.0, 0.0}, 2.0, 0.3});
  EXPECT_THAT(failure_ahead(std::move(world)),
              StartsWith("front left wheel stuck in 'mud', sinkage 0.20 m"));
}

/// Why the vehicle cannot stand at the start.
std::string start_fault(World world, const Pose2& start = {}) {
  world.T_world_start = start;
  const Site site(std::move(world));
  try {
    VehicleModel(site, {}, {}, 1, 0);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(VehicleFailure, StartMustHaveRoom) {
  EXPECT_EQ(start_fault(with_post(), {4.5, 0.0, 0.0}),
            "the vehicle cannot stand at the start: collision with 'post'");
  EXPECT_EQ(start_fault(box_tunnel(), {100.0, 0.0, 0.0}),
            "the vehicle cannot stand at the start: no floor");
  EXPECT_EQ(start_fault(box_tunnel({40.0, 4.0, 0.9})),
            "the vehicle cannot stand at the start: collision with 'roof'");
  EXPECT_EQ(start_fault(World{}), "the vehicle cannot stand at the start: no floor");
  EXPECT_EQ(start_fault(box_tunnel(), {3.0, 0.5, 1.0}), "none");
}

}  // namespace
}  // namespace adit
