// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/picture/rgb_image.hpp"

namespace adit {

class Canvas;

/// What a colour means, or the colours from one to another.
struct LegendItem {
  Colour colour;
  std::string name;
  std::optional<Colour> to;  ///< of a ramp, its other end
};

using Legend = std::vector<LegendItem>;

/// Draws the items one beside the other within a width, in as many rows as it takes. Returns where
/// the last row ends [pixels].
double draw_legend(const Canvas& canvas, const Legend& legend, double left, double top,
                   double width);

/// 1, 2 or 5 times a power of ten, the greatest that is no longer than `longest_m`.
inline double scale_bar_m(double longest_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(longest_m)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= longest_m) return step * decade;
  }
  return decade;
}

/// A bar of two halves, `metres` long, whose left end is at x and whose middle line at y, with its
/// length written below. `unit` is what a pixel of lettering is on this sheet.
void draw_scale_bar(const Canvas& canvas, double x, double y, double metres,
                    double pixels_per_metre, double unit);

}  // namespace adit
