// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/derived_layers.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace adit {
namespace {

/// 12 × 12 cells of 0.1 m, observed from column 3 on.
TerrainMap edge_of_view(const std::function<float(int column, int row)>& low_m) {
  TerrainMap map;
  map.cells = {12, 12};
  for (int row = 0; row < map.cells.rows(); ++row) {
    for (int column = 3; column < map.cells.columns(); ++column) {
      TerrainCell& cell = map.cells.at({column, row});
      cell.ground = Ground::kObserved;
      cell.low_m = low_m(column, row);
    }
  }
  set_slope_and_step(map);
  return map;
}

TEST(SlopeAndStep, RailsAtTheEdgeOfTheObservedGroundAreNotASlope) {
  const TerrainMap map = edge_of_view([](int column, int) { return column <= 4 ? 0.11F : 0.0F; });
  for (int column = 3; column < 10; ++column) {
    const float slope_rad = map.cells.at({column, 6}).slope_rad;
    EXPECT_TRUE(std::isnan(slope_rad) || slope_rad < 0.35F) << column;  // drivable
  }
  EXPECT_FLOAT_EQ(map.cells.at({4, 6}).step_m, 0.11F);
}

TEST(SlopeAndStep, ARampIsASlopeTwoCellsFromTheEdgeOfTheObservedGround) {
  const TerrainMap map =
      edge_of_view([](int column, int) { return 0.05F * static_cast<float>(column); });
  EXPECT_TRUE(std::isnan(map.cells.at({4, 6}).slope_rad));
  for (int column = 5; column < 10; ++column) {
    EXPECT_NEAR(map.cells.at({column, 6}).slope_rad, std::atan(0.5), 1e-5);  // single precision
  }
}

constexpr int kGroundSide = 41;

/// 41 × 41 cells of 0.1 m, all observed.
TerrainMap ground_map(const std::function<float(float x_m, float y_m)>& low_m) {
  TerrainMap map;
  map.cells = {kGroundSide, kGroundSide};
  for (int row = 0; row < kGroundSide; ++row) {
    for (int column = 0; column < kGroundSide; ++column) {
      TerrainCell& cell = map.cells.at({column, row});
      cell.ground = Ground::kObserved;
      cell.low_m = low_m(0.1F * static_cast<float>(column), 0.1F * static_cast<float>(row));
    }
  }
  set_slope_and_step(map);
  return map;
}

TEST(SlopeAndStep, APlaneHasNoSteps) {
  for (const float grade : {0.1F, 0.25F, 0.35F}) {
    for (const float direction : {0.0F, 0.7F, 1.57F, 3.0F}) {
      const TerrainMap map = ground_map([&](float x_m, float y_m) {
        return grade * (std::cos(direction) * x_m + std::sin(direction) * y_m);
      });
      for (const TerrainCell& cell : map.cells) {
        EXPECT_LT(cell.step_m, 1e-4) << grade << " towards " << direction;  // single precision
      }
    }
  }
}

TEST(SlopeAndStep, ALedgeKeepsItsHeight) {
  for (const float grade : {0.0F, -0.25F, 0.25F}) {
    const TerrainMap map =
        ground_map([&](float x_m, float) { return grade * x_m + (x_m > 1.95F ? 0.2F : 0.0F); });
    for (int row = 0; row < kGroundSide; ++row) {
      for (const int column : {19, 20}) {
        EXPECT_NEAR(map.cells.at({column, row}).step_m, 0.2, 1e-4) << grade;  // single precision
      }
    }
  }
}

}  // namespace
namespace {

constexpr int kSide = 41;
constexpr int kMiddle = 20;

TerrainMap level_map() {
  TerrainMap map;
  map.cells = {kSide, kSide};
  return map;
}

TEST(Repulsion, DecreasesWithTheDistanceAndEndsAtTheRadius) {
  TerrainMap map = level_map();
  map.cells.at({kMiddle, kMiddle}).coefficient_m = 0.8F;
  set_repulsion(map, {.radius_m = 0.5});
  const float peak = map.cells.at({kMiddle, kMiddle}).repulsion_m;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double distance_m = 0.1 * std::hypot(column - kMiddle, row - kMiddle);
      const double cone = std::max(0.0, 1.0 - distance_m / 0.5);
      EXPECT_NEAR(map.cells.at({column, row}).repulsion_m, peak * cone, 1e-6);  // float
    }
  }
}

TEST(Repulsion, AtTheFootOfAWallEqualsItsCoefficient) {
  TerrainMap map = level_map();
  for (int row = 0; row < kSide; ++row) {
    for (int column = kMiddle; column < kSide; ++column)
      map.cells.at({column, row}).coefficient_m = 0.6F;
  }
  set_repulsion(map, {});
  EXPECT_NEAR(map.cells.at({kMiddle, kMiddle}).repulsion_m, 0.6, 1e-5);  // float
  EXPECT_GT(map.cells.at({kMiddle - 2, kMiddle}).repulsion_m, 0.0F);
  EXPECT_EQ(map.cells.at({kMiddle - 5, kMiddle}).repulsion_m, 0.0F);
}

TEST(Repulsion, IsZeroForPebblesAndUnknownCells) {
  TerrainMap map = level_map();
  map.cells.at({5, 5}).coefficient_m = 0.04F;
  map.cells.at({30, 30}).coefficient_m = std::numeric_limits<float>::quiet_NaN();
  set_repulsion(map, {});
  EXPECT_TRUE(std::all_of(map.cells.begin(), map.cells.end(),
                          [](const TerrainCell& cell) { return cell.repulsion_m == 0.0F; }));
}

TEST(Repulsion, WithZeroRadiusEqualsTheCoefficient) {
  TerrainMap map = level_map();
  map.cells.at({0, 0}).coefficient_m = 0.3F;
  set_repulsion(map, {.radius_m = 0.0});
  EXPECT_NEAR(map.cells.at({0, 0}).repulsion_m, 0.3, 1e-6);
  EXPECT_EQ(map.cells.at({1, 0}).repulsion_m, 0.0F);
}

}  // namespace
}  // namespace adit
