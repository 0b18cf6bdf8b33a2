// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/svg_elements.hpp"

#include "tools/report/html/text_format.hpp"

namespace adit {

std::string svg_point(const Eigen::Vector2d& p) { return fixed(p.x(), 1) + "," + fixed(p.y(), 1); }

std::string svg_group(const char* css_class, const std::string& parts) {
  return parts.empty() ? "" : std::string("<g class=\"") + css_class + "\">" + parts + "</g>";
}

std::string svg_path_element(const std::string& css_class, const std::string& d) {
  return d.empty() ? "" : std::string("<path class=\"") + css_class + "\" d=\"" + d + "\"/>";
}

std::string svg_circle(const std::string& css_class, const Eigen::Vector2d& at, double radius,
                       const std::string& text) {
  const std::string circle = "<circle class=\"" + css_class + "\" cx=\"" + fixed(at.x(), 1) +
                             "\" cy=\"" + fixed(at.y(), 1) + "\" r=\"" + fixed(radius, 1) + "\"";
  return text.empty() ? circle + "/>" : circle + "><title>" + escaped(text) + "</title></circle>";
}

std::string line_data(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  std::string d(1, 'M');
  d += svg_point(a);
  d += 'L';
  d += svg_point(b);
  return d;
}

}  // namespace adit
