// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/indexed_png.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <zlib.h>

#include "common/picture/rgb_image.hpp"
#include "common/text/base64.hpp"

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Pixel = RgbImage::Pixel;

constexpr std::size_t kColoursMax = 256;
/// An image by a palette.
struct IndexedImage {
  std::vector<Pixel> palette;         ///< at most 256 colours
  std::vector<std::uint8_t> indices;  ///< one per pixel
};

/// The highest `bits` bits of each channel.
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

/// Merges colours with equal keys. Nothing if more than 256 colours remain.
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

/// Exact for up to 256 colours, otherwise with as many bits per channel as possible.
IndexedImage indexed_image(const RgbImage& image) {
  for (int bits = 8; bits > 2; --bits) {
    if (auto indexed = indexed_by(image, bits)) return std::move(*indexed);
  }
  return *indexed_by(image, 2);
}

int depth_of(std::size_t colours) {
  if (colours <= 2) return 1;
  if (colours <= 4) return 2;
  return colours <= 16 ? 4 : 8;
}

/// PNG scanlines: filter type 0 (none), then the packed indices.
Bytes rows_of(const RgbImage& image, const Bytes& indices, int depth) {
  const auto width = static_cast<std::size_t>(image.width);
  Bytes rows;
  for (std::size_t row = 0; row < static_cast<std::size_t>(image.height); ++row) {
    rows.push_back(0);
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t bit = x * static_cast<std::size_t>(depth) % 8;
      if (bit == 0) rows.push_back(0);
      const std::size_t shift = 8 - static_cast<std::size_t>(depth) - bit;
      rows.back() = static_cast<std::uint8_t>(rows.back() | indices[row * width + x] << shift);
    }
  }
  return rows;
}

Bytes deflated(const Bytes& bytes) {
  uLongf size = compressBound(bytes.size());
  Bytes packed(size);
  if (compress2(packed.data(), &size, bytes.data(), bytes.size(), 9) != Z_OK) {
    throw std::runtime_error("zlib cannot compress an image");
  }
  packed.resize(size);
  return packed;
}

void append_number(Bytes& bytes, std::uint32_t number) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes.push_back(static_cast<std::uint8_t>(number >> shift & 0xffU));
  }
}

void append_chunk(Bytes& png, std::string_view name, const Bytes& data) {
  append_number(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t from = png.size();
  png.insert(png.end(), name.begin(), name.end());
  png.insert(png.end(), data.begin(), data.end());
  append_number(png, static_cast<std::uint32_t>(
                         crc32(0, png.data() + from, static_cast<uInt>(png.size() - from))));
}

Bytes header_of(const RgbImage& image, int depth) {
  constexpr std::uint8_t kPaletteColour = 3;
  Bytes header;
  append_number(header, static_cast<std::uint32_t>(image.width));
  append_number(header, static_cast<std::uint32_t>(image.height));
  for (const std::uint8_t byte : {static_cast<std::uint8_t>(depth), kPaletteColour, std::uint8_t{0},
                                  std::uint8_t{0}, std::uint8_t{0}}) {
    header.push_back(byte);
  }
  return header;
}

}  // namespace

std::vector<std::uint8_t> indexed_png(const RgbImage& image,
                                      const std::optional<Pixel>& transparent) {
  if (image.width <= 0 || image.height <= 0) throw std::invalid_argument("an image has no pixels");
  const IndexedImage indexed = indexed_image(image);
  const int depth = depth_of(indexed.palette.size());
  Bytes palette;
  Bytes alpha;
  for (const Pixel& colour : indexed.palette) {
    palette.insert(palette.end(), colour.begin(), colour.end());
    alpha.push_back(transparent && colour == *transparent ? 0 : 255);
  }
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  append_chunk(png, "IHDR", header_of(image, depth));
  append_chunk(png, "PLTE", palette);
  if (transparent) append_chunk(png, "tRNS", alpha);
  append_chunk(png, "IDAT", deflated(rows_of(image, indexed.indices, depth)));
  append_chunk(png, "IEND", {});
  return png;
}

std::string data_uri(const std::string& media_type, std::span<const std::uint8_t> bytes) {
  return "data:" + media_type + ";base64," + base64(bytes);
}

}  // namespace adit
