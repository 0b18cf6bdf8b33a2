// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/text_lines.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::string_view kTokenSeparators = " \t\r,;";

}  // namespace

std::optional<std::string_view> TextLines::next() {
  const auto remaining = rest();
  if (remaining.empty()) return std::nullopt;
  const auto end = std::find(remaining.begin(), remaining.end(), '\n');
  const auto length = static_cast<std::size_t>(end - remaining.begin());
  offset_ += std::min(length + 1, remaining.size());
  ++line_;
  std::string_view line(reinterpret_cast<const char*>(remaining.data()), length);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::optional<std::string_view> TextLines::next_nonblank() {
  auto line = next();
  while (line && line->find_first_not_of(kTokenSeparators) == std::string_view::npos) line = next();
  return line;
}

void TextLines::fail(const std::string& reason) const {
  throw std::runtime_error(fmt::format("line {}: {}", line_, reason));
}

std::string_view take_token(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kTokenSeparators), text.size()));
  const std::string_view token = text.substr(0, text.find_first_of(kTokenSeparators));
  text.remove_prefix(token.size());
  return token;
}

}  // namespace adit
