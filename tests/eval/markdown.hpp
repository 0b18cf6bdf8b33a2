// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <string>

namespace adit {

/// Formats as printf does; truncates the text to 399 bytes.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

/// Prints the heading of a Markdown table, "| a | b |", and the separator below it.
inline void print_heading(const std::string& heading) {
  std::cout << heading << "\n|";
  const auto columns = std::count(heading.begin(), heading.end(), '|') - 1;
  for (std::ptrdiff_t i = 0; i < columns; ++i) std::cout << "---|";
  std::cout << std::endl;
}

}  // namespace adit
