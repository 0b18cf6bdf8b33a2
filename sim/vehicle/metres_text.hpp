// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace adit {

/// A length for people, such as "0.25 m".
inline std::string metres_text(double length_m) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f m", length_m);
  return text.data();
}

}  // namespace adit
