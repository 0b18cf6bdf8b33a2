// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace adit {
namespace {

constexpr float kGamma = 2.2F;
constexpr std::array<std::array<double, 2>, kSamplesPerPixel> kOffsets = {
    {{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}};

std::uint8_t to_byte(float light) {
  const float shown = std::pow(std::clamp(light, 0.0F, 1.0F), 1.0F / kGamma);
  return static_cast<std::uint8_t>(std::lround(255.0F * shown));
}

}  // namespace

Rgb linear(unsigned hex) {
  const Rgb shown(static_cast<float>(hex >> 16U & 0xffU), static_cast<float>(hex >> 8U & 0xffU),
                  static_cast<float>(hex & 0xffU));
  return (shown / 255.0F).array().pow(kGamma);
}

RgbImage::Pixel to_pixel(const Rgb& light) {
  return {to_byte(light.x()), to_byte(light.y()), to_byte(light.z())};
}

RgbImage render(int width, int height, const RowPainter& paint) {
  RgbImage image(width, height);
  const auto count = static_cast<std::size_t>(width) * kSamplesPerPixel;
  std::vector<Eigen::Vector2d> samples(count);
  std::vector<Rgb> light(count);
  for (int row = 0; row < height; ++row) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [du, dv] = kOffsets[i % kSamplesPerPixel];
      const std::size_t column = i / kSamplesPerPixel;
      samples[i] = {static_cast<double>(column) + du, row + dv};
    }
    paint(samples, light);
    for (int column = 0; column < width; ++column) {
      const Rgb* first = light.data() + static_cast<std::ptrdiff_t>(column) * kSamplesPerPixel;
      const Rgb sum = first[0] + first[1] + first[2] + first[3];
      image.at(column, row) = to_pixel(sum / kSamplesPerPixel);
    }
  }
  return image;
}

}  // namespace adit
