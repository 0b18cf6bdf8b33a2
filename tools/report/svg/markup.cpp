// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/markup.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "tools/report/text_format.hpp"

namespace adit {

std::string svg_point(const Eigen::Vector2d& p) {
  return fmt::format("{},{}", fixed(p.x(), 1), fixed(p.y(), 1));
}

std::string svg_group(const char* css_class, const std::string& parts) {
  return parts.empty() ? "" : fmt::format(R"(<g class="{}">{}</g>)", css_class, parts);
}

std::string svg_path_element(const std::string& css_class, const std::string& d) {
  return d.empty() ? "" : fmt::format(R"(<path class="{}" d="{}"/>)", css_class, d);
}

std::string svg_circle(const std::string& css_class, const Eigen::Vector2d& at, double radius,
                       const std::string& text) {
  const std::string title =
      text.empty() ? "/>" : fmt::format("><title>{}</title></circle>", escaped(text));
  return fmt::format(R"(<circle class="{}" cx="{}" cy="{}" r="{}"{})", css_class, fixed(at.x(), 1),
                     fixed(at.y(), 1), fixed(radius, 1), title);
}

std::string line_data(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return fmt::format("M{}L{}", svg_point(a), svg_point(b));
}

std::string style_file(std::string_view name) {
  for (StyleFile& file : style_files()) {
    if (file.name == name) return std::move(file.text);
  }
  throw std::invalid_argument(fmt::format("no embedded file {}", name));
}

}  // namespace adit
