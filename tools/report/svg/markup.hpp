// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace adit {

// SVG elements, each with a CSS class. Parameters named text are escaped.

/// <g>; empty without parts.
std::string svg_group(const char* css_class, const std::string& parts);
/// <path>; empty without data.
std::string svg_path_element(const std::string& css_class, const std::string& d);
/// <circle>; `text` is its tooltip.
std::string svg_circle(const std::string& css_class, const Eigen::Vector2d& at, double radius,
                       const std::string& text = "");
/// Path data of a line from a to b.
std::string line_data(const Eigen::Vector2d& a, const Eigen::Vector2d& b);
/// "12.3,45.6".
std::string svg_point(const Eigen::Vector2d& p);

// Style sheets.

/// A file of tools/report that cmake/AditEmbed compiles into the program.
struct StyleFile {
  std::string name;  ///< without extension: "map", "terrain"
  std::string text;
};

/// map.css and terrain.css. Generated.
std::vector<StyleFile> style_files();

/// Text of one of these files. Throws std::invalid_argument for an unknown name.
std::string style_file(std::string_view name);

}  // namespace adit
