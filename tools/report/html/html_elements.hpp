// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

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

}  // namespace adit
