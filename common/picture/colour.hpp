// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace adit {

/// Shares of 1.
struct Colour {
  double red;
  double green;
  double blue;
  double alpha = 1.0;
};

constexpr Colour rgb(unsigned hex, double alpha = 1.0) {
  return {(hex >> 16U & 0xffU) / 255.0, (hex >> 8U & 0xffU) / 255.0, (hex & 0xffU) / 255.0, alpha};
}

}  // namespace adit
