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
    std::string longer = line;
    longer.append(line.empty() ? "" : " ").append(word);
    const bool fits = canvas.text_width(longer, style.size, style.bold) <= width;
    if (!fits && !line.empty()) draw(line);
    line = fits || line.empty() ? longer : word;
  }
  draw(line);
  return top;
}

}  // namespace adit
