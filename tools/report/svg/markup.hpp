// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace adit {

// HTML elements. Parameters named html are inserted as they are, parameters named text are escaped.

/// <tag attributes>html</tag>
std::string element(const std::string& tag, const std::string& html,
                    const std::string& attributes = "");

struct HtmlRow {
  std::vector<std::string> cells;  ///< html
  std::string attributes = {};
};
/// A table with a head row, in a box that scrolls horizontally on narrow screens.
std::string html_table(const std::string& caption_text, const std::vector<std::string>& head_texts,
                       const std::vector<HtmlRow>& rows);

/// Names (text) with their values (html), side by side where the width allows it.
using HtmlMetrics = std::vector<std::pair<std::string, std::string>>;
std::string html_metrics(const HtmlMetrics& metrics);

/// A <details> element, closed.
std::string html_details(const std::string& summary_text, const std::string& html);

// SVG elements, each with a CSS class.

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

// Templates.

/// A file of tools/report that cmake/AditEmbed compiles into the program.
struct PageFile {
  std::string name;  ///< without extension: "page", "style", "script", "map"
  std::string text;
};

/// page.html, style.css, script.js and map.css. Generated.
std::vector<PageFile> page_files();

/// Text of one of these files. Throws std::invalid_argument for an unknown name.
std::string page_file(std::string_view name);

/// Replaces each `{{name}}` of a template by its value; values are inserted as they are and not
/// searched again. Throws std::invalid_argument for a placeholder without a value.
std::string fill_template(std::string_view text,
                          const std::map<std::string, std::string, std::less<>>& values);

}  // namespace adit
