// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/sheet.hpp"

#include <cmath>

#include "common/picture/palette.hpp"

namespace adit {
namespace {

constexpr double kRound = 24.0;  // margin

}  // namespace

void write_sheet(const std::filesystem::path& path, double width, const DrawDown& draw) {
  const double bottom = draw(Canvas(1, 1), kRound, kRound);
  const Canvas canvas(static_cast<int>(std::ceil(width + 2.0 * kRound)),
                      static_cast<int>(std::ceil(bottom + kRound)));
  canvas.colour(kOpen);
  cairo_paint(canvas.cairo());
  draw(canvas, kRound, kRound);
  canvas.write_png(path);
}

}  // namespace adit
