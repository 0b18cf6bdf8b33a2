// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/scale_bar.hpp"

#include <cstdio>

#include "common/picture/palette.hpp"

namespace adit {

void draw_scale_bar(const Canvas& canvas, double x, double y, double metres,
                    double pixels_per_metre, double unit) {
  const double length = metres * pixels_per_metre;
  canvas.colour(kInk);
  canvas.fill_rectangle(x, y - 3.0 * unit, length, 6.0 * unit);
  canvas.colour(kOpen);
  canvas.fill_rectangle(x + length / 2.0, y - 1.5 * unit, length / 2.0 - 1.5 * unit, 3.0 * unit);
  char label[32];
  std::snprintf(label, sizeof(label), "%g m", metres);
  canvas.colour(kInk);
  canvas.text("0", x, y + 24.0 * unit, 15.0 * unit, false, Align::kLeft);
  canvas.text(label, x + length, y + 24.0 * unit, 15.0 * unit, false, Align::kCentre);
}

}  // namespace adit
