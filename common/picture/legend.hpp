// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/picture/colour.hpp"

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

}  // namespace adit
