// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/text_block.hpp"

#include <sstream>

namespace adit {

double draw_text_block(const Canvas& canvas, const std::string& text, double left, double top,
                       double width, const TextStyle& style) {
  const auto draw = [&](const std::string& line) {
    canvas.text(line, left, top + style.size, style.size, style.bold, Align::kLeft);
    top += style.line;
  };
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (!line.empty() && canvas.text_width(longer, style.size, style.bold) > width) {
      draw(line);
      line = word;
    } else {
      line = longer;
    }
  }
  draw(line);
  return top;
}

}  // namespace adit
