// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/scale_bar.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include "common/picture/palette.hpp"

namespace adit {
namespace {

TEST(ScaleBar, IsARoundLengthThatFits) {
  EXPECT_DOUBLE_EQ(scale_bar_m(1.0), 1.0);
  EXPECT_DOUBLE_EQ(scale_bar_m(1.9), 1.0);
  EXPECT_DOUBLE_EQ(scale_bar_m(4.9), 2.0);
  EXPECT_DOUBLE_EQ(scale_bar_m(9.0), 5.0);
  EXPECT_DOUBLE_EQ(scale_bar_m(0.07), 0.05);
  EXPECT_DOUBLE_EQ(scale_bar_m(120.0), 100.0);
}

/// Blue of a pixel; the ink has little, the paper much.
int blue(const Canvas& canvas, int x, int y) {
  cairo_surface_t* surface = cairo_get_target(canvas.cairo());
  cairo_surface_flush(surface);
  return cairo_image_surface_get_data(surface)[y * cairo_image_surface_get_stride(surface) + 4 * x];
}

TEST(ScaleBar, IsAsLongAsItSays) {
  const Canvas canvas(200, 80);
  canvas.colour(kPaper);
  canvas.fill_rectangle(0, 0, 200, 80);
  draw_scale_bar(canvas, 20.0, 30.0, 5.0, 24.0, 1.0);  // 120 pixels, in the row of its upper rim
  EXPECT_GT(blue(canvas, 18, 28), 200);
  EXPECT_LT(blue(canvas, 20, 28), 100);
  EXPECT_LT(blue(canvas, 139, 28), 100);
  EXPECT_GT(blue(canvas, 141, 28), 200);
}

TEST(Canvas, TakesPixelsAsTheyAre) {
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
