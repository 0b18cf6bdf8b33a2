// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/surface/tunnel_rises.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"

namespace adit {
namespace {

constexpr double kReachM = 0.5;

TunnelLine risen(const std::string& name, const std::vector<Eigen::Vector2d>& points,
                 const std::vector<double>& rise_m) {
  return {.name = name,
          .points = points,
          .width_m = 3.0,
          .entrance = false,
          .rise_m = rise_m,
          .rise_grade = "sudden"};
}

TEST(TunnelRises, NoRisesAreNothing) {
  EXPECT_EQ(TunnelRises::of({risen("a", {{0.0, 0.0}, {9.0, 0.0}}, {})}, {}, kReachM), nullptr);
}

TEST(TunnelRises, AreTheProfileOfAStraightTunnel) {
  const auto rises = TunnelRises::of(
      {risen("a", {{0.0, 0.0}, {40.0, 0.0}}, {5.0, 0.0, 15.0, 3.0, 25.0, 1.0})}, {}, kReachM);
  for (const double across_m : {-1.5, 0.0, 0.7}) {
    EXPECT_NEAR((*rises)({2.0, across_m}), 0.0, 1e-12);
    EXPECT_NEAR((*rises)({10.0, across_m}), 1.5, 1e-12);
    EXPECT_NEAR((*rises)({20.0, across_m}), 2.0, 1e-12);
    EXPECT_NEAR((*rises)({33.0, across_m}), 1.0, 1e-12);
  }
  EXPECT_EQ((*rises)({20.0, 30.0}), 0.0);  // rock
}

TEST(TunnelRises, AGradeGoesThroughABend) {
  const double length_m = 20.0 + std::hypot(20.0, 6.0);
  const auto rises = TunnelRises::of(
      {risen("a", {{0.0, 0.0}, {20.0, 0.0}, {40.0, 6.0}}, {0.0, 0.0, length_m, 0.3 * length_m})},
      {}, kReachM);
  const TunnelLine line{"a", {{0.0, 0.0}, {20.0, 0.0}, {40.0, 6.0}}, 3.0, false};
  constexpr double kStep = 0.1;
  for (double s_m = 1.0; s_m < 38.0; s_m += kStep) {
    const double rise_m = (*rises)(line.at(s_m + kStep).p_world) - (*rises)(line.at(s_m).p_world);
    EXPECT_NEAR(rise_m / kStep, 0.3, 0.02) << s_m;  // a twelfth at a bend of 17 degrees
  }
}

TEST(TunnelRises, RejectAListThatIsNotValid) {
  const auto of = [](const std::vector<double>& rise_m) {
    return TunnelRises::of({risen("raise", {{0.0, 0.0}, {9.0, 0.0}}, rise_m)}, {}, kReachM);
  };
  EXPECT_THROW(of({0.0}), std::invalid_argument);
  EXPECT_THROW(of({0.0, 1.0, 0.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(of({0.0, std::nan("")}), std::invalid_argument);
}

WorldDescription junction(double rise_of_side_m) {
  WorldDescription description;
  description.heights.floor_relief.height_m = 0.0;
  description.heights.roof_relief.height_m = 0.0;
  description.wall_relief.height_m = 0.0;
  TunnelDescription main{"main", {0.0, 0.0, 40.0, 0.0}, 4.0, true};
  TunnelDescription side{"side", {20.0, 0.0, 20.0, 30.0}, 3.0, false};
  side.rise_m = {6.0, 0.0, 16.0, rise_of_side_m};
  side.rise_grade = "sudden";
  description.plan.tunnels = {main, side};
  description.T_world_start = {3.0, 0.0, 0.0};
  return description;
}

TEST(TunnelRises, FloorsAreContinuousWhereTunnelsMeet) {
  WorldDescription description = junction(2.5);
  description.plan.tunnels[1].rise_m = {0.0, 0.6, 16.0, 0.6};  // 0.6 m above the main tunnel
  const World world = build_world(description);
  constexpr double kStep = 0.02;
  for (double x = 17.0; x < 23.0; x += kStep) {
    for (double y = -1.9; y < 6.0; y += kStep) {
      const auto here = world.truth.floor_at({x, y});
      const auto along = world.truth.floor_at({x + kStep, y});
      const auto across = world.truth.floor_at({x, y + kStep});
      if (!here || !along || !across) continue;
      // 0.6 m over 2 m, four times as steep at most
      EXPECT_LT(std::abs(*along - *here), 1.2 * kStep) << x << " " << y;
      EXPECT_LT(std::abs(*across - *here), 1.2 * kStep) << x << " " << y;
    }
  }
}

TEST(TunnelRises, RaysHitFloorAndRoofAtTheirClosedForm) {
  const Site site(build_world(junction(2.5)));
  for (const double y : {3.0, 7.0, 10.0, 13.4, 18.0, 25.0}) {
    const double floor_m = std::clamp((y - 6.0) / 10.0, 0.0, 1.0) * 2.5;
    const Eigen::Vector3f middle(20.0F, static_cast<float>(y), static_cast<float>(floor_m) + 1.0F);
    const auto down = site.scene().cast({middle, -Eigen::Vector3f::UnitZ()}, 5.0F);
    const auto up = site.scene().cast({middle, Eigen::Vector3f::UnitZ()}, 5.0F);
    ASSERT_TRUE(down && up) << y;
    EXPECT_NEAR(down->distance_m, 1.0, 1e-3) << y;  // no kink of the profile within 0.2 m
    EXPECT_NEAR(up->distance_m, 1.0, 1e-3) << y;
    EXPECT_NEAR(site.world().truth.floor_at({20.0, y}).value(), floor_m, 1e-9);
  }
}

TEST(TunnelRises, ASillIsAStepOfItsHeight) {
  WorldDescription description = junction(0.12);
  description.plan.tunnels[1].rise_m = {15.0, 0.0, 15.05, 0.12};
  const Site site(build_world(description));
  const auto floor = [&](float y) {
    const auto hit = site.scene().cast({{20.0F, y, 1.0F}, -Eigen::Vector3f::UnitZ()}, 5.0F);
    return 1.0 - hit.value().distance_m;
  };
  EXPECT_NEAR(floor(14.7F), 0.0, 1e-6);  // an edge of the mesh before it
  EXPECT_NEAR(floor(15.3F), 0.12, 1e-6);
}

}  // namespace
}  // namespace adit
