// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/records/terrain_hazards.hpp"

#include <functional>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kRoofM = 2.0;

/// Even ground of 6 m by 6 m with a roof above, changed by `change` for each centre of a cell.
TerrainMap terrain(const std::function<void(const Eigen::Vector2d&, TerrainCell&)>& change) {
  TerrainMap map;
  map.p_level_corner = {0.0, -3.0};
  map.cells = Grid2<TerrainCell>(60, 60);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Eigen::Vector2i cell = map.cells.cell(i);
    TerrainCell& at = map.cells[i];
    at.ground = Ground::kObserved;
    at.clearance_m = kRoofM;
    change(map.centre(cell.x(), cell.y()), at);
  }
  return map;
}

bool in_box(const Eigen::Vector2d& p, double from_x, double to_x, double half_y) {
  return p.x() > from_x && p.x() < to_x && std::abs(p.y()) < half_y;
}

std::optional<Hazard> only(const std::vector<Hazard>& hazards, const char* kind) {
  if (hazards.size() != 1 || hazards.front().kind != kind) return std::nullopt;
  return hazards.front();
}

std::vector<Hazard> hazards_of(const TerrainMap& map) { return hazards_of(map, 7, 0.5, Vehicle{}); }

TEST(TerrainHazards, AreNoneOfEvenGround) {
  EXPECT_TRUE(hazards_of(terrain([](const auto&, TerrainCell&) {})).empty());
}

TEST(TerrainHazards, NameAPitWithItsPlaceAndDepth) {
  const auto hazard = only(hazards_of(terrain([](const Eigen::Vector2d& p, TerrainCell& cell) {
                             if (in_box(p, 3.0, 4.2, 0.6)) cell.low_m = -0.8F;
                           })),
                           "drop");
  ASSERT_TRUE(hazard);
  EXPECT_NEAR(hazard->value, 0.8, 1e-6);
  EXPECT_NEAR(hazard->T_odom_centre.plan.x, 3.6, 0.05);
  EXPECT_NEAR(hazard->T_odom_centre.plan.y, 0.0, 0.05);
  EXPECT_NEAR(hazard->T_odom_centre.z_m, 0.5, 1e-9);
}

TEST(TerrainHazards, NameALedgeByTheBeamsThatPassBelowIt) {
  EXPECT_TRUE(only(hazards_of(terrain([](const Eigen::Vector2d& p, TerrainCell& cell) {
                     if (p.x() < 4.0) return;
                     cell.ground = Ground::kBelowRay;
                     cell.low_m = -0.6F;
                   })),
                   "drop"));
}

TEST(TerrainHazards, SayNothingOfGroundHiddenBehindACrest) {
  EXPECT_TRUE(hazards_of(terrain([](const Eigen::Vector2d& p, TerrainCell& cell) {
                if (p.x() < 4.0) return;
                cell.ground = Ground::kBelowRay;
                cell.low_m = 0.1F;
              })).empty());
}

TEST(TerrainHazards, SayNothingOfTheFootOfAHeap) {
  EXPECT_TRUE(hazards_of(terrain([](const Eigen::Vector2d& p, TerrainCell& cell) {
                if (in_box(p, 2.0, 4.0, 1.0)) cell.low_m = 0.7F;
              })).empty());
}

TEST(TerrainHazards, SayNothingOfASteadyGrade) {
  EXPECT_TRUE(hazards_of(terrain([](const Eigen::Vector2d& p, TerrainCell& cell) {
                cell.low_m = static_cast<float>(-0.25 * p.x());
              })).empty());
}

TEST(TerrainHazards, NameWaterWithItsArea) {
  const auto no_return = [](double length_m) {
    return terrain([length_m](const Eigen::Vector2d& p, TerrainCell& cell) {
      if (!in_box(p, 2.0, 2.0 + length_m, 1.0)) return;
      cell.ground = Ground::kNoReturn;
      cell.low_m = std::numeric_limits<float>::quiet_NaN();
    });
  };
  const auto hazard = only(hazards_of(no_return(3.0)), "water");
  ASSERT_TRUE(hazard);
  EXPECT_NEAR(hazard->value, 6.0, 1e-6);
  EXPECT_EQ(hazard->unit, "m²");
  EXPECT_TRUE(hazards_of(no_return(0.3)).empty());
}

TEST(TerrainHazards, NameALowRoofOverGroundOnly) {
  const Vehicle vehicle;
  const auto low = [&](double coefficient_m) {
    return terrain([&vehicle, coefficient_m](const Eigen::Vector2d& p, TerrainCell& cell) {
      if (!in_box(p, 3.0, 4.0, 1.0)) return;
      cell.clearance_m = static_cast<float>(vehicle.height_m - 0.2);
      cell.coefficient_m = static_cast<float>(coefficient_m);
    });
  };
  const auto hazard = only(hazards_of(low(0.0)), "low roof");
  ASSERT_TRUE(hazard);
  EXPECT_NEAR(hazard->value, vehicle.height_m - 0.2, 1e-6);
  EXPECT_TRUE(hazards_of(low(0.5)).empty()) << "a wall";
}

}  // namespace
}  // namespace adit
