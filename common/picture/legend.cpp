// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/legend.hpp"

#include <fmt/format.h>

#include "common/picture/canvas.hpp"
#include "common/picture/palette.hpp"

namespace adit {
namespace {

constexpr double kText = 15.0;
constexpr double kBox = 15.0;    // height, and width for a single colour
constexpr double kRamp = 70.0;   // width of a ramp
constexpr double kToName = 6.0;  // from the box to the text
constexpr double kApart = 20.0;  // between items
constexpr double kRow = 24.0;

double box_width(const LegendItem& item) { return item.to ? kRamp : kBox; }

void draw_box(const Canvas& canvas, const LegendItem& item, double left, double top) {
  const double width = box_width(item);
  canvas.colour(kInk);
  canvas.fill_rectangle(left - 1.0, top - 1.0, width + 2.0, kBox + 2.0);
  for (double x = 0.0; x < width; x += 1.0) {
    canvas.colour(item.to ? blend(item.colour, *item.to, x / width) : item.colour);
    canvas.fill_rectangle(left + x, top, 1.0, kBox);
  }
}

}  // namespace

double draw_legend(const Canvas& canvas, const Legend& legend, double left, double top,
                   double width) {
  double x = left;
  double y = top;
  for (const LegendItem& item : legend) {
    const double needed = box_width(item) + kToName + canvas.text_width(item.name, kText, false);
    if (x > left && x + needed > left + width) {
      x = left;
      y += kRow;
    }
    draw_box(canvas, item, x + 1.0, y + 1.0);
    canvas.colour(kInk);
    canvas.text(item.name, x + box_width(item) + kToName, y + kBox - 1.0, kText, false,
                Align::kLeft);
    x += needed + kApart;
  }
  return y + kRow;
}

void draw_scale_bar(const Canvas& canvas, double x, double y, double metres,
                    double pixels_per_metre, double unit) {
  const double length = metres * pixels_per_metre;
  canvas.colour(kInk);
  canvas.fill_rectangle(x, y - 3.0 * unit, length, 6.0 * unit);
  canvas.colour(kOpen);
  canvas.fill_rectangle(x + length / 2.0, y - 1.5 * unit, length / 2.0 - 1.5 * unit, 3.0 * unit);
  canvas.colour(kInk);
  canvas.text("0", x, y + 24.0 * unit, 15.0 * unit, false, Align::kLeft);
  canvas.text(fmt::format("{:g} m", metres), x + length, y + 24.0 * unit, 15.0 * unit, false,
              Align::kCentre);
}

}  // namespace adit
