// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/terrain_picture.hpp"

#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace adit {
namespace {

TerrainMap one_of_each() {
  TerrainMap map;
  map.cells = {7, 1};
  for (int i = 0; i < 5; ++i) map.cells.at({i, 0}).ground = static_cast<Ground>(i);
  map.cells.at({0, 0}).clearance_m = 3.0F;
  map.cells.at({5, 0}) = {.ground = Ground::kObserved, .coefficient_m = 0.4F};
  map.cells.at({6, 0}) = {.ground = Ground::kObserved,
                          .clearance_m = std::numeric_limits<float>::infinity()};
  return map;
}

TEST(TerrainLayer, IsBrightForEasyGroundAndAHighRoof) {
  const TerrainMap map = one_of_each();
  const RgbImage coefficient = terrain_image(map);
  EXPECT_EQ(coefficient.at(0, 0), (RgbImage::Pixel{255, 255, 255}));
  EXPECT_EQ(coefficient.at(5, 0), (RgbImage::Pixel{0, 0, 0}));
  const RgbImage clearance = terrain_image(map, TerrainLayer::kClearance);
  EXPECT_EQ(clearance.at(0, 0), (RgbImage::Pixel{255, 255, 255}));
  EXPECT_EQ(clearance.at(5, 0), (RgbImage::Pixel{0, 0, 0}));
  EXPECT_NE(clearance.at(6, 0), clearance.at(0, 0));  // no roof observed
}

TEST(TerrainLayer, HasOneColourAndNamePerClassOfUnknownGroundInAllLayers) {
  const TerrainMap map = one_of_each();
  std::set<RgbImage::Pixel> colours;
  for (int i = 1; i < 5; ++i) colours.insert(terrain_image(map).at(i, 0));
  EXPECT_EQ(colours.size(), 4U);
  for (const TerrainLayer layer :
       {TerrainLayer::kCoefficient, TerrainLayer::kClearance, TerrainLayer::kKnowledge}) {
    for (int i = 1; i < 5; ++i) {
      EXPECT_EQ(terrain_image(map, layer).at(i, 0), terrain_image(map).at(i, 0));
    }
    EXPECT_GE(legend_of(layer).size(), 5U);
    EXPECT_NE(std::string(title_of(layer)), "");
  }
}

TEST(TerrainLayer, HasYUp) {
  TerrainMap map;
  map.cells = {1, 2};
  map.cells.at({0, 1}).ground = Ground::kObserved;
  EXPECT_EQ(terrain_image(map).at(0, 0), (RgbImage::Pixel{255, 255, 255}));
}

}  // namespace
}  // namespace adit
