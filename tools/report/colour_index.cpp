// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/colour_index.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace adit {
namespace {

using Pixel = RgbImage::Pixel;

constexpr std::size_t kColoursMax = 256;

/// Colours that share their highest bits are one.
Pixel key_of(const Pixel& pixel, int bits) {
  const auto mask = static_cast<std::uint8_t>(0xffU << (8U - static_cast<unsigned>(bits)));
  return {static_cast<std::uint8_t>(pixel[0] & mask), static_cast<std::uint8_t>(pixel[1] & mask),
          static_cast<std::uint8_t>(pixel[2] & mask)};
}

struct Sum {
  std::array<std::uint64_t, 3> channels{};
  std::uint64_t count = 0;
  std::uint8_t index = 0;
};

/// Nothing where there are more colours than a palette holds.
std::optional<IndexedImage> indexed_by(const RgbImage& image, int bits) {
  std::map<Pixel, Sum> sums;
  for (const Pixel& pixel : image.pixels) {
    Sum& sum = sums[key_of(pixel, bits)];
    if (sums.size() > kColoursMax) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i) sum.channels[i] += pixel[i];
    ++sum.count;
  }
  IndexedImage indexed;
  for (auto& [key, sum] : sums) {
    sum.index = static_cast<std::uint8_t>(indexed.palette.size());
    Pixel mean{};
    for (std::size_t i = 0; i < 3; ++i) {
      mean[i] = static_cast<std::uint8_t>((sum.channels[i] + sum.count / 2) / sum.count);
    }
    indexed.palette.push_back(mean);
  }
  indexed.indices.reserve(image.pixels.size());
  for (const Pixel& pixel : image.pixels) {
    indexed.indices.push_back(sums[key_of(pixel, bits)].index);
  }
  return indexed;
}

}  // namespace

IndexedImage indexed_image(const RgbImage& image) {
  for (int bits = 8; bits > 2; --bits) {
    if (auto indexed = indexed_by(image, bits)) return std::move(*indexed);
  }
  return *indexed_by(image, 2);
}

}  // namespace adit
