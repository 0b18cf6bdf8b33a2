// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/sheet.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "common/picture/cloud_picture.hpp"
#include "common/picture/legend.hpp"
#include "common/picture/map_panel.hpp"
#include "common/picture/terrain_picture.hpp"
#include "common/picture/text_block.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

int height_of(const std::filesystem::path& path) {
  cairo_surface_t* image = cairo_image_surface_create_from_png(path.c_str());
  const int height = cairo_image_surface_get_height(image);
  cairo_surface_destroy(image);
  return height;
}

TEST(Sheet, IsAsHighAsWhatIsDrawnOnIt) {
  const test::ScratchFolder folder;
  write_sheet(folder / "a.png", 100.0, [](const Canvas&, double, double top) { return top + 300; });
  EXPECT_EQ(height_of(folder / "a.png"), 300 + 2 * 24);  // and its margins
}

TEST(Sheet, SaysWhereItCannotBeWritten) {
  EXPECT_THROW(
      write_sheet("/nowhere/a.png", 10.0, [](const Canvas&, double, double top) { return top; }),
      std::runtime_error);
}

TEST(TextBlock, TakesAsManyLinesAsTheWidthNeeds) {
  const Canvas canvas(1, 1);
  const std::string text = "No path: an obstacle is in the way after 2 m";
  EXPECT_DOUBLE_EQ(draw_text_block(canvas, text, 0, 10, 2000, {.line = 20}), 30);
  EXPECT_GE(draw_text_block(canvas, text, 0, 10, 100, {.line = 20}), 70);
  EXPECT_DOUBLE_EQ(draw_text_block(canvas, "", 0, 10, 100, {.line = 20}), 30);
}

TEST(Legend, GoesOnInTheNextRowWhereAnItemDoesNotFit) {
  const Canvas canvas(1, 1);
  const Legend legend(6, LegendItem{rgb(0xff0000), "too high to drive over", {}});
  EXPECT_GT(draw_legend(canvas, legend, 0, 0, 300), draw_legend(canvas, legend, 0, 0, 3000));
}

TEST(MapPanel, PutsPlacesWhereTheirCellsAreDrawn) {
  TerrainMap map;
  map.columns = 20;
  map.rows = 10;
  map.cell_m = 0.1;
  map.p_level_corner = {-0.5, -0.5};
  map.cells.resize(200);
  const Canvas canvas(400, 400);
  const MapPanel panel(canvas, map, 50.0, 0.0, 200.0);
  EXPECT_DOUBLE_EQ(panel.cell_px(), 10.0);
  EXPECT_DOUBLE_EQ(panel.pixel({-0.5, -0.5}).x(), 50.0);
  EXPECT_DOUBLE_EQ(panel.pixel({-0.5, -0.5}).y(), panel.bottom());
  EXPECT_DOUBLE_EQ(panel.pixel({0.5, 0.5}).x(), 150.0);
  EXPECT_DOUBLE_EQ(panel.pixel({0.5, 0.5}).y(), panel.bottom() - 100.0);
}

TEST(TerrainPng, IsNoLargerForALargerMap) {
  const test::ScratchFolder folder;
  TerrainMap map;
  map.columns = 1500;
  map.rows = 6000;
  map.cell_m = 0.02;
  map.cells.resize(9'000'000);
  write_terrain_png(map, folder / "large.png");
  EXPECT_LT(height_of(folder / "large.png"), 1500);
}

TEST(CloudPicture, ShowsWhatLiesAheadAndNothingBehind) {
  Cloud cloud;
  cloud.lines.resize(1);
  const RgbImage empty = cloud_image(cloud, 100, 50);
  cloud.lines[0].points = {{-3.0F, 0.0F, 0.5F}};
  EXPECT_EQ(cloud_image(cloud, 100, 50).pixels, empty.pixels);
  cloud.lines[0].points = {{3.0F, 1.0F, 0.5F}};
  const RgbImage image = cloud_image(cloud, 100, 50);
  int left = 0;
  for (int x = 0; x < 50; ++x) {
    for (int y = 0; y < 50; ++y) left += image.at(x, y) != empty.at(x, y) ? 1 : 0;
  }
  EXPECT_GT(left, 0);  // y is to the left
}

}  // namespace
}  // namespace adit
