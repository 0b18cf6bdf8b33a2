// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html/markup.hpp"

#include <cstddef>
#include <stdexcept>
#include <utility>

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

std::string page_file(std::string_view name) {
  for (PageFile& file : page_files()) {
    if (file.name == name) return std::move(file.text);
  }
  throw std::invalid_argument(fmt::format("no embedded file {}", name));
}

std::string fill_template(std::string_view text,
                          const std::map<std::string, std::string, std::less<>>& values) {
  std::string filled;
  while (true) {
    const std::size_t open = text.find("{{");
    filled += text.substr(0, open);
    if (open == std::string_view::npos) return filled;
    const std::size_t close = text.find("}}", open);
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto value = values.find(name);
    if (close == std::string_view::npos || value == values.end()) {
      throw std::invalid_argument(fmt::format("no value for the placeholder {}", name));
    }
    filled += value->second;
    text.remove_prefix(close + 2);
  }
}

}  // namespace adit
