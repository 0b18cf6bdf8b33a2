// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace adit {

/// Colour channels, 0 to 1.
struct Colour {
  double red;
  double green;
  double blue;
  double alpha = 1.0;
};

constexpr Colour rgb(unsigned hex, double alpha = 1.0) {
  return {(hex >> 16U & 0xffU) / 255.0, (hex >> 8U & 0xffU) / 255.0, (hex & 0xffU) / 255.0, alpha};
}

/// An image, row by row from the top, initially black.
struct RgbImage {
  using Pixel = std::array<std::uint8_t, 3>;  ///< red, green, blue

  RgbImage(int width_px, int height_px)
      : width(width_px),
        height(height_px),
        pixels(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

  [[nodiscard]] Pixel& at(int x, int y) { return pixels[index(x, y)]; }
  [[nodiscard]] const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }

  int width;
  int height;
  std::vector<Pixel> pixels;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace adit
