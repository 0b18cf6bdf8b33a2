// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/search/search_report.hpp"

#include <cstddef>

#include <fmt/format.h>

#include "common/text/message_text.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

/// The text as one cell of a table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : message_line(text)) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string row(std::size_t number, const FoundKind& kind) {
  return fmt::format(
      "| {} | {} | {} | unit {}, {} | {}{} | [{}](units/{}) |\n", number, cell(kind.kind),
      kind.failures, kind.first_unit, duration_text(kind.first_cpu_s),
      kind.parameters.empty() ? "all simple" : cell(kind.parameters),
      kind.is_minimal ? "" : " (not shrunk to the end)", kind.simplest.id, kind.simplest.id);
}

}  // namespace

std::string search_report(const SearchResult& result) {
  std::string text = fmt::format(
      "# {}\n\n{} units, {} failures of {} kinds, {} of CPU time, {} restarts{}\n", result.name,
      result.units, result.failures, result.kinds.size(), duration_text(result.cpu_s),
      result.restarts, result.interrupted ? "; interrupted" : "");
  if (result.kinds.empty()) return text;
  text +=
      "\n| | kind | failures | found after (units, CPU time) | simplest: parameters that differ "
      "from the simple ones | unit |\n|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < result.kinds.size(); ++i) text += row(i + 1, result.kinds[i]);
  text += "\nRepeat:\n";
  for (std::size_t i = 0; i < result.kinds.size(); ++i)
    text += fmt::format("\n{}.\n\n```sh\n{}\n```\n", i + 1, result.kinds[i].command);
  return text;
}

}  // namespace adit
