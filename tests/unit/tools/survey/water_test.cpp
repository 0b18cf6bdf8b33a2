// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/survey/water/flood.hpp"
#include "tools/survey/water/mine_water.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr double kFloodCellM = 0.1;

/// A tunnel of 20 m by 4 m whose floor has two bowls: at x = 5 (radius 1.5 m, 0.6 m deep), and at
/// x = 14 (1 m, 0.3 m); between them a sill 0.2 m high at x = 10. It continues at x = 20.
double floor_m(const Eigen::Vector2d& p) {
  const auto bowl = [&](double x, double radius, double depth) {
    const double r = (p - Eigen::Vector2d(x, 0.0)).norm() / radius;
    return r < 1.0 ? -depth * (1.0 - r * r) : 0.0;
  };
  const double sill = std::abs(p.x() - 10.0) < 0.5 ? 0.2 : 0.0;
  return bowl(5.0, 1.5, 0.6) + bowl(14.0, 1.0, 0.3) + sill;
}

ColumnGrid tunnel() {
  ColumnGrid grid{kFloodCellM, Grid2<SurveyColumn>(CellBox{{-5, -25}, {205, 25}})};
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    const Eigen::Vector2i cell = grid.columns.cell(i);
    const Eigen::Vector2d p = centre_of(cell, kFloodCellM);
    SurveyColumn& column = grid.columns[i];
    const bool rock = p.x() < 0.0 || std::abs(p.y()) > 2.0;
    if (rock || p.x() > 20.0) {
      column.kind = rock ? SurveyColumn::Kind::kWall : SurveyColumn::Kind::kUnseen;
      continue;
    }
    column.kind = SurveyColumn::Kind::kVoid;
    column.floor_m = static_cast<float>(floor_m(p));
    column.roof_m = 2.0F;
    column.floor_sd_m = 0.01F;
  }
  return grid;
}

TEST(Flood, FillsHollowsToWhereTheySpill) {
  const auto bodies = hollows(flood_ground(tunnel(), nullptr));
  ASSERT_EQ(bodies.size(), 2U);
  // Behind the sill water stands 0.2 m deep on 9.5 m by 4 m, and in the bowl.
  const double bowl_m3 = 0.5 * std::numbers::pi * 1.5 * 1.5 * 0.6;
  EXPECT_NEAR(bodies[0].volume_m3, 9.5 * 4.0 * 0.2 + bowl_m3, 0.1);
  EXPECT_NEAR(bodies[0].depth_m, 0.8, 0.01);
  EXPECT_NEAR(bodies[0].level_m, 0.2, 1e-6);
  EXPECT_NEAR(bodies[0].deepest.x(), 5.0, 0.11);
  ASSERT_TRUE(bodies[0].spill);
  EXPECT_NEAR(bodies[0].spill->place.x(), 10.0, 0.55);
  EXPECT_FALSE(bodies[0].spill->out_of_sight);
  EXPECT_NEAR(bodies[1].volume_m3, 0.5 * std::numbers::pi * 0.3, 0.02);
}

TEST(Flood, StandsAtALevel) {
  const FloodGround ground = flood_ground(tunnel(), nullptr);
  const auto bodies = flooded_at(ground, -0.15, 0.5);
  ASSERT_EQ(bodies.size(), 2U);
  // Of a paraboloid: area and volume of what is below the level.
  const double share = (0.6 - 0.15) / 0.6;
  EXPECT_NEAR(bodies[0].area_m2, std::numbers::pi * 1.5 * 1.5 * share, 0.1);
  EXPECT_NEAR(bodies[0].volume_m3, 0.5 * std::numbers::pi * 1.5 * 1.5 * share * 0.45, 0.05);
  EXPECT_FALSE(bodies[0].reaches_unseen);
  ASSERT_TRUE(bodies[0].spill);
  EXPECT_NEAR(bodies[0].spill->level_m, 0.2, 1e-6);  // over the sill
}

TEST(Flood, SaysWhereItContinuesBeyondWhatWasSeen) {
  const auto bodies = flooded_at(flood_ground(tunnel(), nullptr), 0.3, 0.5);
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_TRUE(bodies[0].reaches_unseen);
  ASSERT_TRUE(bodies[0].spill);
  EXPECT_TRUE(bodies[0].spill->out_of_sight);
}

TEST(Flood, DoesNotTakeAShadowForAnOutlet) {
  ColumnGrid grid = tunnel();
  for (int i = 0; i < 4; ++i) {
    grid.columns.at({40 + i, 20}).kind = SurveyColumn::Kind::kUnseen;
    grid.columns.at({40 + i, 20}).floor_m = SurveyColumn::kNone;
  }
  EXPECT_EQ(flood_ground(grid, nullptr).outlets.at({41, 19}), 0);
  EXPECT_EQ(flood_ground(grid, nullptr).outlets.at({199, 0}), 1);
}

TEST(Flood, HasNoHollowsWithoutAnOutlet) {
  ColumnGrid grid = tunnel();
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    if (grid.columns[i].kind == SurveyColumn::Kind::kUnseen)
      grid.columns[i].kind = SurveyColumn::Kind::kWall;
  }
  const FloodGround ground = flood_ground(grid, nullptr);
  EXPECT_TRUE(hollows(ground).empty());
  const auto bodies = flooded_at(ground, -0.15, 0.5);
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_TRUE(bodies[0].spill);  // over the sill, to the other one
  EXPECT_FALSE(flooded_at(ground, 0.3, 0.5).front().spill);
}

TEST(MineWater, StatesItsUncertainty) {
  const ColumnGrid grid = tunnel();
  const auto bodies = mine_water(grid, grid, nullptr, {}, -0.15);
  ASSERT_EQ(bodies.size(), 4U);  // two hollows, two flooded
  const SurveyedWater& flooded = bodies[2];
  EXPECT_EQ(flooded.kind, SurveyedWater::Kind::kFlooded);
  EXPECT_NEAR(flooded.depth_m.sd, 0.01, 1e-6);
  // A level that is off by 1 cm changes the volume by the area times 1 cm.
  EXPECT_NEAR(flooded.volume_m3.sd, 0.01 * flooded.area_m2.value, 0.01);
  EXPECT_GT(flooded.area_m2.sd, 0.0);
}

TEST(MineWater, FindsStandingWaterByItsShore) {
  ColumnGrid seen = tunnel();
  const ColumnGrid filled = tunnel();
  // Water in the first bowl up to 0.2 m below the floor: no returns from it.
  double area_m2 = 0.0;
  for (std::size_t i = 0; i < seen.columns.size(); ++i) {
    const Eigen::Vector2d p = centre_of(seen.columns.cell(i), kFloodCellM);
    if (p.x() > 9.0 || !(seen.columns[i].floor_m < -0.2F)) continue;
    seen.columns[i].floor_m = SurveyColumn::kNone;
    area_m2 += kFloodCellM * kFloodCellM;
  }
  HazardMark mark;
  mark.hazard.kind = "water";
  mark.hazard.size_m = {3.0, 3.0};
  mark.T_survey_centre = {{5.0, 0.0, 0.0}, 0.0};
  const auto bodies = mine_water(seen, filled, nullptr, {mark}, {});
  ASSERT_FALSE(bodies.empty());
  const SurveyedWater& water = bodies.front();
  EXPECT_EQ(water.kind, SurveyedWater::Kind::kSeen);
  EXPECT_NEAR(water.area_m2.value, area_m2, 0.05);
  EXPECT_NEAR(water.body.level_m, -0.2, 3.0 * water.level_sd_m);
  EXPECT_TRUE(std::isnan(water.depth_m.value));
  EXPECT_THAT(water_table(bodies, SurveyFrame::local()), HasSubstr("1,standing water,"));
}

}  // namespace
}  // namespace adit
