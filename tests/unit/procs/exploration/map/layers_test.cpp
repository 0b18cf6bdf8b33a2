// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

/// A local map that observed 11 m by 11 m.
MapFootprint area_at(double x, double y, double z, double sd_m = 0.05) {
  MapFootprint footprint;
  for (double dx = -5.0; dx <= 5.0; dx += MapFootprint::kCellM) {
    for (double dy = -5.0; dy <= 5.0; dy += MapFootprint::kCellM)
      footprint.points.emplace_back(x + dx, y + dy, z);
  }
  footprint.z_variance = sd_m * sd_m;
  return footprint;
}

bool share_a_layer(const std::vector<int>& a, const std::vector<int>& b) {
  return std::ranges::any_of(a, [&](int layer) { return std::ranges::count(b, layer) > 0; });
}

TEST(SeparateLayers, LeavesALevelMineInOneLayer) {
  std::vector<MapFootprint> footprints;
  for (int i = 0; i < 20; ++i) footprints.push_back(area_at(5.0 * i, 0.0, 0.25 * 5.0 * i));
  for (const auto& layers : separate_layers(footprints)) EXPECT_EQ(layers, std::vector<int>{0});
}

TEST(SeparateLayers, SeparatesWhatLiesAbove) {
  const auto layers = separate_layers({area_at(0, 0, 0), area_at(30, 0, 4), area_at(0, 1, 5)});
  EXPECT_FALSE(share_a_layer(layers[0], layers[2]));
}

TEST(SeparateLayers, DoesNotSeparateByUncertainHeights) {
  const auto layers = separate_layers({area_at(0, 0, 0, 2.0), area_at(0, 1, 5, 2.0)});
  EXPECT_EQ(layers[0], layers[1]);
}

TEST(SeparateLayers, KeepsNeighboursTogetherAlongASpiral) {
  std::vector<MapFootprint> footprints;
  constexpr double kRadiusM = 15.0;
  constexpr double kTurnM = 2.0 * std::numbers::pi * kRadiusM;
  constexpr double kClimbOfTurnM = 6.0;
  for (double s_m = 0.0; s_m < 4.0 * kTurnM; s_m += 5.0) {
    const double angle = s_m / kRadiusM;
    footprints.push_back(area_at(kRadiusM * std::cos(angle), kRadiusM * std::sin(angle),
                                 kClimbOfTurnM * s_m / kTurnM));
  }
  const auto layers = separate_layers(footprints);
  int most = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    most = std::max(most, std::ranges::max(layers[i]));
    if (i > 0) {
      EXPECT_TRUE(share_a_layer(layers[i - 1], layers[i])) << i;
    }
    const auto above = static_cast<std::size_t>(std::lround(kTurnM / 5.0));
    if (i >= above) {
      EXPECT_FALSE(share_a_layer(layers[i - above], layers[i])) << i;
    }
  }
  EXPECT_LE(most, 8);
}

TEST(Atlas, IsTheMapForASingleLayer) {
  const Atlas atlas({{{-40, -30}, {50, 60}}}, 0.2);
  const Eigen::Vector2d p(3.0, 1e3);
  EXPECT_EQ(atlas.layer_of(p), 0);
  EXPECT_EQ(atlas.to_map(p), p);
}

TEST(Atlas, LaysLayersSideBySide) {
  const std::vector<CellBox> boxes{
      {{-40, -30}, {50, 60}}, {{-20, -700}, {20, -600}}, {{0, 0}, {9, 9}}};
  const Atlas atlas(boxes, 0.2);
  ASSERT_EQ(atlas.layers(), 3);
  for (int layer = 0; layer < atlas.layers(); ++layer) {
    const CellBox& box = boxes[static_cast<std::size_t>(layer)];
    for (const Eigen::Vector2i& cell :
         {box.from, Eigen::Vector2i(box.to - Eigen::Vector2i(1, 1))}) {
      const Eigen::Vector2d p_map = centre_of(cell, 0.2);
      const Eigen::Vector2d p_atlas = atlas.to_atlas(p_map, layer);
      EXPECT_EQ(atlas.layer_of(p_atlas), layer);
      EXPECT_LT((atlas.to_map(p_atlas) - p_map).norm(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace adit
