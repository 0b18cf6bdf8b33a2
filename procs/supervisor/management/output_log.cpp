// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/output_log.hpp"

#include <algorithm>
#include <utility>

#include "common/text/text_check.hpp"

namespace adit {
namespace {

std::string as_text(std::string line) {
  std::ranges::replace(line, '\r', ' ');
  for (std::size_t at = 0; at < line.size(); ++at) {
    const auto bad = find_non_text_byte(std::string_view(line).substr(at));
    if (!bad) break;
    at += *bad;
    line[at] = '?';
  }
  return line;
}

}  // namespace

void OutputLog::add(std::string_view bytes) {
  for (const char c : bytes) {
    if (c != '\n') partial_line_ += c;
    if (c == '\n' || partial_line_.size() == kLineBytesMax) {
      if (partial_line_.ends_with('\r')) partial_line_.pop_back();
      lines_.push_back(as_text(std::exchange(partial_line_, {})));
      if (on_line_) on_line_(lines_.back());
    }
  }
  for (; lines_.size() > kLinesMax; ++first_) lines_.pop_front();
}

void OutputLog::end_line() {
  if (!partial_line_.empty()) add("\n");
}

OutputLines OutputLog::since(std::int64_t next, std::size_t bytes_max) const {
  std::int64_t begin = this->next();
  std::size_t bytes = 0;
  while (begin > std::max(next, first_)) {
    bytes += lines_[static_cast<std::size_t>(begin - 1 - first_)].size() + 1;
    if (bytes > bytes_max) break;
    --begin;
  }
  const auto from = static_cast<std::ptrdiff_t>(begin - first_);
  return {
      {lines_.begin() + from, lines_.end()}, std::max<std::int64_t>(begin - next, 0), this->next()};
}

std::string text_of(const OutputLines& unread) {
  std::string text;
  if (unread.omitted > 0)
    text.append("(").append(std::to_string(unread.omitted)).append(" lines omitted)\n");
  for (const std::string& line : unread.lines) text.append(line).append("\n");
  return text;
}

}  // namespace adit
