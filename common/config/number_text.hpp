// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace adit {

/// The shortest text that reads back as the same number, as std::to_chars writes it: 0.1, 1e+05,
/// 1e-04. Not fmt's "{}", which chooses the notation by the exponent (100000, 0.0001):
/// configurations and g2o files stay the same to the byte across versions.
inline std::string number_text(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value);
  return {text, error == std::errc{} ? end : text};
}

/// Parses a number that spans the entire text, independent of the locale; `inf` and `nan` are
/// numbers. Nothing if other characters precede or follow it, or if T cannot represent it.
template <class T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

}  // namespace adit
