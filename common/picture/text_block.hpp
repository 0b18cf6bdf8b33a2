// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/picture/canvas.hpp"

namespace adit {

struct TextStyle {
  double size = 17.0;  ///< of the letters [pixels]
  double line = 26.0;  ///< height of a line
  bool bold = false;
};

/// Draws words in as many lines as it takes to stay within a width. Returns where the last ends
/// [pixels].
double draw_text_block(const Canvas& canvas, const std::string& text, double left, double top,
                       double width, const TextStyle& style);

}  // namespace adit
