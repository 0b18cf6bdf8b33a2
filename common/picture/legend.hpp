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

/// The meaning of a colour, or of a colour ramp.
struct LegendItem {
  Colour colour;
  std::string name;
  std::optional<Colour> to;  ///< the other end of a ramp
};

using Legend = std::vector<LegendItem>;

/// Draws the items side by side within a width, in as many rows as necessary. Returns the lower end
/// of the last row [pixels].
double draw_legend(const Canvas& canvas, const Legend& legend, double left, double top,
                   double width);

/// The largest of 1, 2 or 5 times a power of ten that is not longer than `longest_m`.
inline double scale_bar_m(double longest_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(longest_m)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= longest_m) return step * decade;
  }
  return decade;
}

/// Draws a scale bar of two halves, `metres` long, with its left end at x and its centre line at y,
/// and its length below. `unit`: scale of the lettering on this sheet [pixels].
void draw_scale_bar(const Canvas& canvas, double x, double y, double metres,
                    double pixels_per_metre, double unit);

}  // namespace adit
