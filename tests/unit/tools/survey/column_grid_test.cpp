// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/raster/column_grid.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/tools/survey/survey_scene.hpp"
#include "tools/survey/plan/outlines.hpp"
#include "tools/survey/raster/elevation_rasters.hpp"
#include "tools/survey/raster/void_volume.hpp"

namespace adit {
namespace {

class BoxTunnelColumns : public testing::Test {
 protected:
  ColumnGrid grid_of(const Cloud& cloud) {
    clouds_ = test::stored({cloud});
    return column_grid(RegisteredCloud(clouds_, graph_), test::path_along_x(0.0, 10.0));
  }

  SurveyGraph graph_ = test::graph_along_x(3, 5.0);
  CloudStore clouds_;
};

TEST_F(BoxTunnelColumns, HaveFloorAndRoof) {
  const ColumnGrid grid = grid_of(test::scan_of_tunnel(0.0, 10.0, {2.03, 2.2}));
  const SurveyColumn& middle = grid.columns.at(cell_of({5.05, 0.05}, grid.cell_m));
  EXPECT_EQ(middle.kind, SurveyColumn::Kind::kVoid);
  EXPECT_NEAR(middle.floor_m, 0.0, 1e-6);
  EXPECT_NEAR(middle.roof_m, 2.2, 1e-6);
  EXPECT_GE(middle.floor_sd_m, 0.01F);
  const SurveyColumn& wall = grid.columns.at(cell_of({5.05, 2.03}, grid.cell_m));
  EXPECT_EQ(wall.kind, SurveyColumn::Kind::kWall);
}

TEST_F(BoxTunnelColumns, AreTheSameInPartsOfFewReturns) {
  clouds_ = test::stored(
      {test::scan_of_tunnel(0.0, 6.0, {2.05, 2.2}), test::scan_of_tunnel(4.0, 10.0, {1.55, 2.1})});
  const RegisteredCloud cloud(clouds_, graph_);
  const ColumnGrid whole = column_grid(cloud, test::path_along_x(0.0, 10.0));
  for (const std::size_t returns_max : {1UL, 1000UL, 5000UL}) {
    const ColumnGrid grid =
        column_grid(cloud, test::path_along_x(0.0, 10.0), {.returns_max = returns_max});
    ASSERT_EQ(grid.columns.box(), whole.columns.box());
    for (std::size_t i = 0; i < grid.columns.size(); ++i) {
      const SurveyColumn& column = grid.columns[i];
      const SurveyColumn& expected = whole.columns[i];
      EXPECT_EQ(column.kind, expected.kind);
      EXPECT_THAT(column.floor_m, testing::NanSensitiveFloatEq(expected.floor_m));
      EXPECT_THAT(column.roof_m, testing::NanSensitiveFloatEq(expected.roof_m));
    }
  }
}

TEST_F(BoxTunnelColumns, HaveTheVolumeOfTheBox) {
  const ColumnGrid grid = grid_of(test::scan_of_tunnel(0.0, 10.0, {2.05, 2.2}));
  const VoidVolume volume = void_volume(grid, with_gaps_filled(grid, nullptr));
  EXPECT_NEAR(volume.area_m2.value, 41.0, 0.02 * 41.0);  // a tenth of a cell at each end
  EXPECT_NEAR(volume.volume_m3.value, 90.2, 0.02 * 90.2);
  EXPECT_GT(volume.volume_m3.sd, 0.0);
}

TEST_F(BoxTunnelColumns, FillAHoleInTheFloorAndSaySo) {
  Cloud cloud = test::scan_of_tunnel(0.0, 10.0, {2.05, 2.2});
  for (CloudLine& line : cloud.lines) {
    std::erase_if(line.points, [](const Eigen::Vector3f& p) {
      return p.z() == 0.0F && std::abs(p.x() - 5.0F) < 0.5F && std::abs(p.y()) < 0.5F;
    });
  }
  const ColumnGrid grid = grid_of(cloud);
  const auto hole = cell_of({5.0, 0.0}, grid.cell_m);
  EXPECT_TRUE(std::isnan(grid.columns.at(hole).floor_m));
  const ColumnGrid filled = with_gaps_filled(grid, nullptr);
  EXPECT_NEAR(filled.columns.at(hole).floor_m, 0.0, 1e-6);
  const VoidVolume volume = void_volume(grid, filled);
  EXPECT_NEAR(volume.filled_m2, 1.0, 0.25);  // a cell at each side
  EXPECT_NEAR(volume.volume_m3.value, 90.2, 0.02 * 90.2);
}

TEST_F(BoxTunnelColumns, ShowTheLevelOfThePathWhereWorkingsCross) {
  Cloud cloud = test::scan_of_tunnel(0.0, 10.0, {2.05, 2.0});
  for (CloudLine line : test::scan_of_tunnel(0.0, 10.0, {2.05, 2.0}).lines) {
    for (Eigen::Vector3f& p : line.points) p.z() += 6.0F;
    cloud.lines.push_back(line);
  }
  const ColumnGrid grid = grid_of(cloud);
  const SurveyColumn& middle = grid.columns.at(cell_of({5.05, 0.05}, grid.cell_m));
  EXPECT_NEAR(middle.floor_m, 0.0, 1e-6);
  EXPECT_NEAR(middle.roof_m, 2.0, 1e-6);
}

TEST_F(BoxTunnelColumns, BecomeRastersFromTheNorthWest) {
  const ColumnGrid grid = grid_of(test::scan_of_tunnel(0.0, 10.0, {2.05, 2.2}));
  const SurveyFrame frame({1000.0, 2000.0, 100.0}, 1.0, "", "", "");
  const Raster raster = floor_raster(grid, frame);
  EXPECT_NEAR(raster.north_west.x(), 1000.0, 0.11);
  EXPECT_NEAR(raster.north_west.y(), 2002.1, 0.11);
  const auto row = static_cast<std::size_t>(raster.rows / 2);
  const auto column = static_cast<std::size_t>(raster.columns / 2);
  const float value =
      raster.bands[0].values[row * static_cast<std::size_t>(raster.columns) + column];
  EXPECT_NEAR(value, 100.0F, 1e-4F);
}

TEST_F(BoxTunnelColumns, AreOutlinedByWallsAndPillars) {
  Cloud cloud = test::scan_of_tunnel(0.0, 10.0, {3.05, 2.2});
  for (CloudLine& line : cloud.lines) {  // a pillar of 2 m x 2 m
    const float x = line.points.front().x();
    if (std::abs(x - 5.0F) > 1.0F) continue;
    std::erase_if(line.points, [](const Eigen::Vector3f& p) { return std::abs(p.y()) < 1.0F; });
    for (float z = 0.0F; z <= 2.2F; z += 0.05F) {
      for (const float y : {-1.0F, 1.0F}) line.points.emplace_back(x, y, z);
      if (std::abs(x - 5.0F) < 0.93F) continue;
      for (float y = -1.0F; y <= 1.0F; y += 0.05F) line.points.emplace_back(x, y, z);
    }
  }
  const auto outlines = void_outlines(grid_of(cloud));
  ASSERT_EQ(outlines.size(), 2U);
  const VoidOutline& pillar = outlines[outlines[0].is_pillar ? 0 : 1];
  const VoidOutline& wall = outlines[outlines[0].is_pillar ? 1 : 0];
  EXPECT_TRUE(pillar.is_pillar);
  EXPECT_FALSE(wall.is_pillar);
  EXPECT_NEAR(pillar.area_m2, 4.0, 0.9);  // half a cell around it
}

}  // namespace
}  // namespace adit
