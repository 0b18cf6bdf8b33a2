// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/canvas.hpp"

#include <stdexcept>

#include <cairo.h>
#include <gtest/gtest.h>

#include "common/picture/cloud_picture.hpp"
#include "common/picture/legend.hpp"
#include "common/picture/map_panel.hpp"
#include "common/picture/palette.hpp"
#include "common/picture/terrain_picture.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

int height_of(const std::filesystem::path& path) {
  cairo_surface_t* image = cairo_image_surface_create_from_png(path.c_str());
  const int height = cairo_image_surface_get_height(image);
  cairo_surface_destroy(image);
  return height;
}

TEST(Sheet, IsAsHighAsItsContent) {
  const test::ScratchFolder folder;
  write_sheet(folder / "a.png", 100.0, [](const Canvas&, double, double top) { return top + 300; });
  EXPECT_EQ(height_of(folder / "a.png"), 300 + 2 * 24);  // and its margins
}

TEST(Sheet, NamesTheFileThatItCannotWrite) {
  EXPECT_THROW(
      write_sheet("/nowhere/a.png", 10.0, [](const Canvas&, double, double top) { return top; }),
      std::runtime_error);
}

TEST(TextBlock, BreaksLinesAtTheWidth) {
  const Canvas canvas(1, 1);
  const std::string text = "No path: an obstacle blocks the path after 2 m";
  EXPECT_DOUBLE_EQ(draw_text_block(canvas, text, 0, 10, 2000, {.line = 20}), 30);
  EXPECT_GE(draw_text_block(canvas, text, 0, 10, 100, {.line = 20}), 70);
  EXPECT_DOUBLE_EQ(draw_text_block(canvas, "", 0, 10, 100, {.line = 20}), 30);
}

TEST(Legend, BreaksRowsAtTheWidth) {
  const Canvas canvas(1, 1);
  const Legend legend(6, LegendItem{rgb(0xff0000), "too high to drive over", {}});
  EXPECT_GT(draw_legend(canvas, legend, 0, 0, 300), draw_legend(canvas, legend, 0, 0, 3000));
}

TEST(MapPanel, PlacesPointsOnTheirCells) {
  TerrainMap map;
  map.cell_m = 0.1;
  map.p_level_corner = {-0.5, -0.5};
  map.cells = {20, 10};
  const Canvas canvas(400, 400);
  const MapPanel panel(canvas, map, 50.0, 0.0, 200.0);
  EXPECT_DOUBLE_EQ(panel.cell_px(), 10.0);
  EXPECT_DOUBLE_EQ(panel.pixel({-0.5, -0.5}).x(), 50.0);
  EXPECT_DOUBLE_EQ(panel.pixel({-0.5, -0.5}).y(), panel.bottom());
  EXPECT_DOUBLE_EQ(panel.pixel({0.5, 0.5}).x(), 150.0);
  EXPECT_DOUBLE_EQ(panel.pixel({0.5, 0.5}).y(), panel.bottom() - 100.0);
}

TEST(TerrainPng, HasAFixedSize) {
  const test::ScratchFolder folder;
  TerrainMap map;
  map.cell_m = 0.02;
  map.cells = {1500, 6000};
  write_terrain_png(map, folder / "large.png");
  EXPECT_LT(height_of(folder / "large.png"), 1500);
}

TEST(CloudPicture, ShowsPointsAheadOnly) {
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
namespace {

TEST(ScaleBar, IsTheLongestRoundLengthThatFits) {
  EXPECT_DOUBLE_EQ(scale_bar_m(1.0), 1.0);
  EXPECT_DOUBLE_EQ(scale_bar_m(1.9), 1.0);
  EXPECT_DOUBLE_EQ(scale_bar_m(4.9), 2.0);
  EXPECT_DOUBLE_EQ(scale_bar_m(9.0), 5.0);
  EXPECT_DOUBLE_EQ(scale_bar_m(0.07), 0.05);
  EXPECT_DOUBLE_EQ(scale_bar_m(120.0), 100.0);
}

/// Blue of a pixel: low for ink, high for paper.
int blue(const Canvas& canvas, int x, int y) {
  cairo_surface_t* surface = cairo_get_target(canvas.cairo());
  cairo_surface_flush(surface);
  return cairo_image_surface_get_data(surface)[y * cairo_image_surface_get_stride(surface) + 4 * x];
}

TEST(ScaleBar, HasTheGivenLength) {
  const Canvas canvas(200, 80);
  canvas.colour(kPaper);
  canvas.fill_rectangle(0, 0, 200, 80);
  draw_scale_bar(canvas, 20.0, 30.0, 5.0, 24.0, 1.0);  // 120 pixels, in the row of its upper rim
  EXPECT_GT(blue(canvas, 18, 28), 200);
  EXPECT_LT(blue(canvas, 20, 28), 100);
  EXPECT_LT(blue(canvas, 139, 28), 100);
  EXPECT_GT(blue(canvas, 141, 28), 200);
}

TEST(Canvas, CopiesPixels) {
  RgbImage image(2, 1);
  image.at(0, 0) = {10, 20, 30};
  image.at(1, 0) = {200, 100, 50};
  const Canvas canvas(10, 10);
  canvas.image(image, 3, 4);
  EXPECT_EQ(blue(canvas, 3, 4), 30);
  EXPECT_EQ(blue(canvas, 4, 4), 50);
  EXPECT_EQ(blue(canvas, 5, 4), 0);
}

}  // namespace
}  // namespace adit
