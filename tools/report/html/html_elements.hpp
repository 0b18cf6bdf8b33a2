// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace adit {

// Pieces of a page. What is called html is taken as it is; what is called text is escaped.

/// <tag attributes>html</tag>
std::string element(const std::string& tag, const std::string& html,
                    const std::string& attributes = "");

/// A table with a head, in a box that scrolls on narrow screens; each cell is html. Each row may
/// have attributes.
struct HtmlRow {
  std::vector<std::string> cells;
  std::string attributes = {};
};
std::string html_table(const std::string& caption_text, const std::vector<std::string>& head_texts,
                       const std::vector<HtmlRow>& rows);

/// Names with their values (html), side by side where there is room.
using HtmlMetrics = std::vector<std::pair<std::string, std::string>>;
std::string html_metrics(const HtmlMetrics& metrics);

/// What opens at a click.
std::string html_details(const std::string& summary_text, const std::string& html);

}  // namespace adit
