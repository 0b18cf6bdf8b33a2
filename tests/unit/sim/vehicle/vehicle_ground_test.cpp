// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/sim/vehicle/driving.hpp"

namespace adit {
namespace {

constexpr double kFloat = 1e-5;  // of heights of some metres, over an axle

/// A hall whose floor is a plane through (0, 0, 5), rotated about an axis. From 3 m on along x it
/// is higher by a ledge.
World sloping_hall(double angle_rad, const Eigen::Vector3d& axis, double ledge_m = 0.0) {
  const Eigen::AngleAxisd turn(angle_rad, axis);
  World world = box_tunnel({40.0, 40.0, 12.0}, [&](MeshBuilder& builder) {
    OrientedBox slab;
    slab.T_world_box =
        Eigen::Translation3d(0.0, 0.0, 5.0) * turn * Eigen::Translation3d(0.0, 0.0, -0.1);
    slab.half_size = {10.0, 10.0, 0.1};
    builder.begin_part(PartKind::kOther, Material::kRock, "slope");
    builder.box(slab);
    if (ledge_m == 0.0) return;
    slab.T_world_box =
        Eigen::Translation3d(0.0, 0.0, 5.0 + ledge_m) * turn * Eigen::Translation3d(8.0, 0.0, -0.3);
    slab.half_size = {5.0, 10.0, 0.3};
    builder.begin_part(PartKind::kOther, Material::kRock, "ledge");
    builder.box(slab);
  });
  const Eigen::Vector3d normal = turn * Eigen::Vector3d::UnitZ();
  world.truth.floor_height = [normal](const Eigen::Vector2d& p) {
    return 5.0 - p.dot(normal.head<2>()) / normal.z();
  };
  return world;
}

/// Bars of 0.07 m by `height_m` along the tunnel.
World with_rails(std::initializer_list<double> across_m, double height_m) {
  return box_tunnel({}, [&](MeshBuilder& builder) {
    builder.begin_part(PartKind::kRail, Material::kSteel, "rails");
    for (const double y : across_m) {
      builder.box(level_box({0.0, y, 0.5 * height_m}, {30.0, 0.07, height_m}));
    }
  });
}

TEST(VehicleGround, PitchesOnARamp) {
  const double slope = 0.2;
  const Site site(sloping_hall(-slope, Eigen::Vector3d::UnitY()));
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  drive(vehicle, 0.5, 0.0, 5.0);
  ASSERT_FALSE(vehicle.failure()) << *vehicle.failure();
  EXPECT_NEAR((roll_pitch_heading(vehicle) - Eigen::Vector3d(0.0, -slope, 0.0)).norm(), 0.0,
              kFloat);
  // The distance is that along the slope, and a wheel touches it beside its lowest point: r/cos α −
  // r.
  const Eigen::Vector3d p = vehicle.motion().T_world_body.translation();
  const double distance_m = 0.5 * 5.0 - 0.5 * 0.5 / (2.0 * 0.3);
  EXPECT_NEAR(p.x(), distance_m * std::cos(slope), 1e-3);
  EXPECT_NEAR(p.z(), 5.0 + p.x() * std::tan(slope), 0.3 / std::cos(slope) - 0.3 + kFloat);
  EXPECT_NEAR(vehicle.motion().v_body.x(), 0.5, 1e-3);  // heights are floats, time is 10 ms
  EXPECT_NEAR(vehicle.motion().v_body.z(), 0.0, 1e-3);
}

TEST(VehicleGround, RollsOnASideSlope) {
  const double slope = 0.3;
  const Site site(sloping_hall(slope, Eigen::Vector3d::UnitX()));
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  drive(vehicle, 0.5, 0.0, 5.0);
  ASSERT_FALSE(vehicle.failure()) << *vehicle.failure();
  EXPECT_NEAR((roll_pitch_heading(vehicle) - Eigen::Vector3d(slope, 0.0, 0.0)).norm(), 0.0, kFloat);
}

TEST(VehicleGround, KeepsItsHeadingAcrossASlope) {
  World world = sloping_hall(-0.2, Eigen::Vector3d::UnitY());
  world.T_world_start = {0.0, 0.0, 0.7};
  const Site site(std::move(world));
  const VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  const Eigen::Vector3d angles = roll_pitch_heading(vehicle);
  EXPECT_NEAR(angles.z(), 0.7, kFloat);
  // The normal of the body is that of the slope.
  const Eigen::Vector3d up = vehicle.motion().T_world_body.linear().col(2);
  EXPECT_LT((up - Eigen::Vector3d(-std::sin(0.2), 0.0, std::cos(0.2))).norm(), 1e-4);
}

TEST(VehicleGround, StartsOnASlopeUpToItsLimit) {
  for (const Eigen::Vector3d axis : {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()}) {
    const Site site(sloping_hall(0.45, axis));
    const VehicleModel vehicle(site, {}, without_slip(), 1, 0);
    EXPECT_NEAR(std::acos(vehicle.motion().T_world_body(2, 2)), 0.45, 1e-4);
  }
}

TEST(VehicleGround, FindsNoStepOnAPlane) {
  const double slope = deg_to_rad(15.0);
  const Site site(sloping_hall(-slope, Eigen::Vector3d::UnitY()));
  const WheelGroundProbe probe(site.scene(), {});
  for (const double heading : {0.0, 0.7, 3.0}) {
    const double grade_ahead = std::tan(slope) * std::cos(heading);
    const auto ground = probe.under({{1.0, 2.0}, heading, 6.0, grade_ahead});
    ASSERT_TRUE(ground);
    EXPECT_NEAR(ground->step_m, 0.0, kFloat);
  }
}

TEST(VehicleGround, FindsTheHeightOfTheFaceOfAStepOnASlope) {
  for (const double slope : {-0.25, 0.0, 0.25}) {
    const Site site(sloping_hall(-slope, Eigen::Vector3d::UnitY(), 0.2));
    const WheelGroundProbe probe(site.scene(), {});
    const double x = 3.0 * std::cos(slope) + 0.03;  // no ray meets the edge itself
    const auto ground = probe.under({{x, 0.0}, 0.0, 7.0, std::tan(slope)});
    ASSERT_TRUE(ground);
    EXPECT_NEAR(ground->step_m, 0.2, kFloat);
  }
}

TEST(VehicleGround, CountsTheSlopeOfAStandingVehicleOnly) {
  const Site site(sloping_hall(-0.45, Eigen::Vector3d::UnitY()));
  const auto ground = WheelGroundProbe(site.scene(), {}).under({{1.0, 0.0}, 0.0, 6.0, 0.0});
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->step_m, 0.18 * std::tan(0.45), kFloat);  // a steep face before a level body
}

TEST(VehicleGround, ClimbsTheSameStepOnASlopeAsOnLevelGround) {
  for (const double slope : {-0.25, 0.0, 0.25}) {
    for (const double ledge_m : {0.19, 0.21}) {
      const Site site(sloping_hall(-slope, Eigen::Vector3d::UnitY(), ledge_m));
      VehicleModel vehicle(site, {}, without_slip(), 1, 0);
      drive(vehicle, 0.5, 0.0, 12.0);
      EXPECT_EQ(vehicle.failure().has_value(), ledge_m > 0.2)
          << slope << " " << ledge_m << " " << vehicle.failure().value_or("");
    }
  }
}

TEST(VehicleGround, SearchesTheFloorOfAnImportedMesh) {
  World world = box_tunnel({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kOther, Material::kRock, "hillside");
    builder.box(level_box({0.0, 0.0, 30.0}, {40.0, 40.0, 1.0}));  // with room below and above
  });
  world.truth.floor_height = nullptr;
  const Site site(std::move(world));
  const VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  EXPECT_NEAR(vehicle.motion().T_world_body.translation().z(), 0.0, kFloat);
}

TEST(VehicleGround, StraddlesRails) {
  const Site site(with_rails({-0.25, 0.25}, 0.1));
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  drive(vehicle, 0.5, 0.0, 20.0);
  EXPECT_FALSE(vehicle.failure()) << *vehicle.failure();
  EXPECT_NEAR(vehicle.motion().T_world_body.translation().z(), 0.0, kFloat);
  EXPECT_NEAR(roll_pitch_heading(vehicle).norm(), 0.0, kFloat);
}

TEST(VehicleGround, RollsWithTheWheelsOfOneSideOnARail) {
  const Site site(with_rails({0.475}, 0.1));  // under the middle of the left wheels
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  drive(vehicle, 0.5, 0.0, 5.0);
  ASSERT_FALSE(vehicle.failure()) << *vehicle.failure();
  EXPECT_NEAR(roll_pitch_heading(vehicle).x(), std::asin(0.1 / 0.95), kFloat);
  EXPECT_NEAR(roll_pitch_heading(vehicle).y(), 0.0, kFloat);
  EXPECT_NEAR(vehicle.motion().T_world_body.translation().z(), 0.05, kFloat);
}

TEST(VehicleGround, StandsOnALeastSquaresPlaneWithOneWheelOnAStone) {
  World world = box_tunnel({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kRubble, Material::kRock, "stone");
    builder.box(level_box({0.75, 0.475, 0.05}, {0.5, 0.3, 0.1}));
  });
  const Site site(std::move(world));
  const VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  const double pitch = -std::asin(0.05 / 1.5);
  EXPECT_NEAR(roll_pitch_heading(vehicle).y(), pitch, kFloat);
  EXPECT_NEAR(roll_pitch_heading(vehicle).x(), std::asin(0.05 / 0.95 / std::cos(pitch)), kFloat);
  EXPECT_NEAR(vehicle.motion().T_world_body.translation().z(), 0.025, kFloat);
}

TEST(VehicleGround, ClimbsAStepContinuously) {
  World world = box_tunnel({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kFloor, Material::kRock, "ledge");
    builder.box(level_box({8.0, 0.0, 0.0}, {10.0, 4.0, 0.3}));
  });
  const Site site(std::move(world));
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  double before = 0.0;
  while (vehicle.distance_travelled_m() < 6.0 && !vehicle.failure()) {
    drive(vehicle, 0.5, 0.0, kStepS);
    const double z = vehicle.motion().T_world_body.translation().z();
    EXPECT_LT(std::abs(z - before), 0.5 * 0.5 * kStepS + kFloat);  // 45°, with one axle
    before = z;
  }
  EXPECT_FALSE(vehicle.failure()) << *vehicle.failure();
  EXPECT_NEAR(before, 0.15, kFloat);
}

TEST(VehicleGround, SinksIntoMud) {
  World world = box_tunnel();
  world.soft_ground.push_back({"mud", {2.0, 0.0}, 3.0, 0.18});
  const Site site(std::move(world));
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  drive(vehicle, 0.5, 0.0, 6.0);
  ASSERT_FALSE(vehicle.failure()) << *vehicle.failure();
  const Eigen::Isometry3d& T_world_body = vehicle.motion().T_world_body;
  double mean = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d wheel =
        T_world_body * Eigen::Vector3d(i < 2 ? 0.75 : -0.75, i % 2 == 0 ? 0.475 : -0.475, 0.0);
    const double u =
        std::max(0.0, 1.0 - (wheel.head<2>() - Eigen::Vector2d(2.0, 0.0)).squaredNorm() / 9.0);
    EXPECT_NEAR(vehicle.sinkage_m()[i], 0.18 * u * u, 1e-4);  // tilt moves wheels by a little
    mean += 0.25 * vehicle.sinkage_m()[i];
  }
  EXPECT_GT(mean, 0.05);
  EXPECT_NEAR(T_world_body.translation().z(), -mean, kFloat);
}

TEST(VehicleGround, SlipsMoreInMud) {
  World mud = box_tunnel();
  mud.soft_ground.push_back({"mud", {0.0, 0.0}, 30.0, 0.15});
  const Site firm_site(box_tunnel());
  const Site mud_site(std::move(mud));
  VehicleModel firm(firm_site, {}, without_slip(), 1, 0);
  VehicleModel soft(mud_site, {}, without_slip(), 1, 0);
  drive(firm, 0.4, 0.0, 10.0);
  drive(soft, 0.4, 0.0, 10.0);
  EXPECT_LT(soft.distance_travelled_m(), 0.8 * firm.distance_travelled_m());
}

}  // namespace
}  // namespace adit
