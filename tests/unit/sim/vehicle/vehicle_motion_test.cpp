// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/unit/sim/vehicle/driving.hpp"

namespace adit {
namespace {

class SteeredBy : public testing::TestWithParam<const char*> {};

TEST_P(SteeredBy, TheOriginFollowsTheCommandedCircle) {
  const Site site(box_tunnel({40.0, 40.0, 2.0}));
  Vehicle shape;
  shape.steering = GetParam();
  VehicleModel vehicle(site, shape, without_slip(), 1, 0);
  drive(vehicle, 0.0, 0.4, 2.0);  // steers first
  const double half = shape.steering == "ackermann" ? 0.5 * shape.wheelbase_m : 0.0;
  const Eigen::Vector2d centre(-half, std::sqrt(2.5 * 2.5 - half * half));
  for (int i = 0; i < 40; ++i) {
    drive(vehicle, 0.4, 0.4, 1.0);
    const Eigen::Vector2d p = vehicle.motion().T_world_body.translation().head<2>();
    ASSERT_NEAR((p - centre).norm(), 2.5, 1e-9);
  }
  EXPECT_NEAR(vehicle.motion().v_body.x(), 0.4, 1e-3);  // the turn within a step
  EXPECT_NEAR(vehicle.motion().omega_body.z(), 0.4 / centre.y(), 1e-5);
  EXPECT_NEAR(vehicle.motion().v_body.y(), half * 0.4 / centre.y(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(VehicleMotion, SteeredBy, testing::Values("four_wheel", "ackermann"));

TEST(VehicleMotion, CountsItsDistanceInBothDirections) {
  const Site site(box_tunnel());
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  drive(vehicle, 0.3, 0.0, 4.0);   // 0.3 m/s after one second: 0.15 m + 0.9 m
  drive(vehicle, 0.0, 0.0, 1.0);   // 0.3² / (2 · 0.8) m more
  drive(vehicle, -0.3, 0.0, 4.0);  // 1.05 m back
  EXPECT_NEAR(vehicle.distance_travelled_m(), 2.0 * 1.05 + 0.05625, 1e-4);  // heights are floats
  EXPECT_NEAR(vehicle.motion().T_world_body.translation().x(), 0.05625, 2e-5);  // half a step
  EXPECT_EQ(vehicle.motion().utime, 9'000'000);
}

TEST(VehicleMotion, SlipReducesTheDistance) {
  const Site site(box_tunnel({120.0, 6.0, 2.0}));
  VehicleModel vehicle(site, {}, {}, 4, 0);
  double wheels_m = 0.0;
  for (int i = 0; i < 10'000 && !vehicle.failure(); ++i) {
    drive(vehicle, 0.4, 0.0, kStepS);
    wheels_m += vehicle.state().speed_m_s * kStepS;
  }
  EXPECT_FALSE(vehicle.failure());
  // 40 m, of which 20 are independent: 0.02 / √20, three times
  EXPECT_NEAR(1.0 - vehicle.distance_travelled_m() / wheels_m, 0.03, 0.0134);
  const double y = vehicle.motion().T_world_body.translation().y();
  EXPECT_NE(y, 0.0);
  EXPECT_NEAR(y, 0.0, 3.0 * 0.01 * std::sqrt(2.0 * 40.0));  // side slip over as many
}

TEST(VehicleMotion, IsReproducible) {
  const Site site(box_tunnel({40.0, 40.0, 2.0}));
  VehicleModel one(site, {}, {}, 7, 0);
  VehicleModel same(site, {}, {}, 7, 0);
  VehicleModel other(site, {}, {}, 8, 0);
  for (VehicleModel* vehicle : {&one, &same, &other}) drive(*vehicle, 0.4, 0.2, 20.0);
  EXPECT_EQ(one.motion().T_world_body.matrix(), same.motion().T_world_body.matrix());
  EXPECT_EQ(one.motion().v_body, same.motion().v_body);
  EXPECT_EQ(one.distance_travelled_m(), same.distance_travelled_m());
  EXPECT_NE(one.motion().T_world_body.matrix(), other.motion().T_world_body.matrix());
}

TEST(VehicleMotion, ReportsTheSpeedOfTheWheelsAndStops) {
  const Site site(box_tunnel());
  VehicleModel vehicle(site, {}, {}, 1, 500);
  EXPECT_TRUE(vehicle.state().expired);
  drive(vehicle, 0.3, 0.1, 3.0);
  EXPECT_DOUBLE_EQ(vehicle.state().speed_m_s, 0.3);  // slip is not known to it
  EXPECT_DOUBLE_EQ(vehicle.state().curvature_1_m, 0.1);
  EXPECT_EQ(vehicle.state().utime, 3'000'500);
  EXPECT_FALSE(vehicle.state().expired);
  vehicle.command(StopOrder{vehicle.motion().utime, true, "test"});
  EXPECT_TRUE(vehicle.state().stopped);
}

TEST(VehicleMotion, DrawsFromTheBatteryByTimeAndSpeed) {
  const Site site(box_tunnel());
  VehicleModelParams params = without_slip();
  params.battery_wh = 10.0;
  VehicleModel vehicle(site, {}, params, 1, 0);
  drive(vehicle, 0.0, 0.0, 36.0);  // 200 W: 2 Wh
  EXPECT_NEAR(vehicle.state().battery_share, 0.8, 1e-9);
  drive(vehicle, 0.5, 0.0, 9.0);
  // Against rolling resistance at full speed, less what is saved until it has its speed.
  const double drive_w = 680.0 * 9.81 * 0.15 * 0.5 / 0.5;
  const double drawn_wh = (200.0 * 9.0 + drive_w * (9.0 - 0.5 * (0.5 / 0.3))) / 3600.0;
  EXPECT_NEAR(vehicle.state().battery_share, 0.8 - drawn_wh / 10.0, 3e-4);  // one step
}

TEST(VehicleMotion, EndsWithAnEmptyBattery) {
  const Site site(box_tunnel());
  VehicleModelParams params = without_slip();
  params.battery_wh = 1.0;
  VehicleModel vehicle(site, {}, params, 1, 0);
  drive(vehicle, 0.0, 0.0, 17.9);
  EXPECT_FALSE(vehicle.failure());
  drive(vehicle, 0.0, 0.0, 0.2);  // 18 s at 200 W
  EXPECT_EQ(vehicle.failure(), "battery empty after 0.00 m");
}

}  // namespace
}  // namespace adit
