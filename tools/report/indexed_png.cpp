// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/indexed_png.hpp"

#include <cstddef>
#include <stdexcept>
#include <string_view>

#include <zlib.h>

#include "tools/report/colour_index.hpp"

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Pixel = RgbImage::Pixel;

int depth_of(std::size_t colours) {
  if (colours <= 2) return 1;
  if (colours <= 4) return 2;
  return colours <= 16 ? 4 : 8;
}

/// Rows as PNG has them: each with its filter, none, in front.
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
    throw std::runtime_error("an image could not be compressed");
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

std::vector<std::uint8_t> indexed_png(const RgbImage& image, const std::optional<Pixel>& clear) {
  if (image.width <= 0 || image.height <= 0) throw std::invalid_argument("an image without pixels");
  const IndexedImage indexed = indexed_image(image);
  const int depth = depth_of(indexed.palette.size());
  Bytes palette;
  Bytes alpha;
  for (const Pixel& colour : indexed.palette) {
    palette.insert(palette.end(), colour.begin(), colour.end());
    alpha.push_back(clear && colour == *clear ? 0 : 255);
  }
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  append_chunk(png, "IHDR", header_of(image, depth));
  append_chunk(png, "PLTE", palette);
  if (clear) append_chunk(png, "tRNS", alpha);
  append_chunk(png, "IDAT", deflated(rows_of(image, indexed.indices, depth)));
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace adit
