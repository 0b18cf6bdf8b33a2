// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/text_lines.hpp"

#include <algorithm>
#include <stdexcept>

namespace adit {
namespace {

constexpr std::string_view kBetweenWords = " \t\r,;";

}  // namespace

std::optional<std::string_view> TextLines::next() {
  const auto left = rest();
  if (left.empty()) return std::nullopt;
  const auto end = std::find(left.begin(), left.end(), '\n');
  const auto length = static_cast<std::size_t>(end - left.begin());
  done_ += std::min(length + 1, left.size());
  ++line_;
  std::string_view line(reinterpret_cast<const char*>(left.data()), length);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::optional<std::string_view> TextLines::next_filled() {
  auto line = next();
  while (line && line->find_first_not_of(kBetweenWords) == std::string_view::npos) line = next();
  return line;
}

void TextLines::fail(const std::string& what) const {
  throw std::runtime_error("line " + std::to_string(line_) + ": " + what);
}

std::string_view take_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBetweenWords), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBetweenWords));
  text.remove_prefix(word.size());
  return word;
}

}  // namespace adit
