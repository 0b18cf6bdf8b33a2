// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html/html_elements.hpp"

#include <fmt/format.h>

#include "tools/report/html/text_format.hpp"

namespace adit {

std::string element(const std::string& tag, const std::string& html,
                    const std::string& attributes) {
  const char* const space = attributes.empty() ? "" : " ";
  return fmt::format("<{0}{1}{2}>{3}</{0}>", tag, space, attributes, html);
}

std::string html_table(const std::string& caption_text, const std::vector<std::string>& head_texts,
                       const std::vector<HtmlRow>& rows) {
  std::string head;
  for (const std::string& text : head_texts) head += element("th", escaped(text), "scope=\"col\"");
  std::string body;
  for (const HtmlRow& row : rows) {
    std::string cells;
    for (const std::string& cell : row.cells) cells += element("td", cell);
    body += element("tr", cells, row.attributes) + "\n";
  }
  const std::string caption = escaped(caption_text);
  const std::string table =
      element("table", element("caption", caption) + element("thead", element("tr", head)) +
                           element("tbody", body));
  return element(
      "div", table,
      fmt::format(R"(class="scroll" tabindex="0" role="region" aria-label="{}")", caption));
}

std::string html_metrics(const HtmlMetrics& metrics) {
  std::string html;
  for (const auto& [name, value] : metrics) {
    html += element("div", element("dt", escaped(name)) + element("dd", value));
  }
  return element("dl", html, "class=\"figures\"");
}

std::string html_details(const std::string& summary_text, const std::string& html) {
  return element("details", element("summary", escaped(summary_text)) + html);
}

}  // namespace adit
