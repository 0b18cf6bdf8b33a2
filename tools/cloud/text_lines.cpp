// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/text_lines.hpp"

#include <algorithm>
#include <stdexcept>

namespace adit {
namespace {

constexpr std::string_view kTokenSeparators = " \t\r,;";

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

std::optional<std::string_view> TextLines::next_nonblank() {
  auto line = next();
  while (line && line->find_first_not_of(kTokenSeparators) == std::string_view::npos) line = next();
  return line;
}

void TextLines::fail(const std::string& what) const {
  throw std::runtime_error("line " + std::to_string(line_) + ": " + what);
}

std::string_view take_token(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kTokenSeparators), text.size()));
  const std::string_view token = text.substr(0, text.find_first_of(kTokenSeparators));
  text.remove_prefix(token.size());
  return token;
}

}  // namespace adit
