// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/indexed_png.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>

#include <cairo.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using Pixel = RgbImage::Pixel;

/// Decodes with cairo: alpha, red, green, blue of each pixel.
std::vector<std::uint32_t> read_back(const std::vector<std::uint8_t>& png, int width, int height) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "image.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create_from_png((folder / "image.png").c_str()), cairo_surface_destroy);
  EXPECT_EQ(cairo_surface_status(surface.get()), CAIRO_STATUS_SUCCESS);
  EXPECT_EQ(cairo_image_surface_get_width(surface.get()), width);
  EXPECT_EQ(cairo_image_surface_get_height(surface.get()), height);
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width * height));
  for (int row = 0; row < height; ++row) {
    const auto* from =
        cairo_image_surface_get_data(surface.get()) +
        static_cast<std::ptrdiff_t>(row) * cairo_image_surface_get_stride(surface.get());
    std::memcpy(&pixels[static_cast<std::size_t>(row * width)], from,
                4 * static_cast<std::size_t>(width));
  }
  return pixels;
}

std::uint32_t rgb_of(const Pixel& p) {
  return static_cast<std::uint32_t>(p[0]) << 16U | static_cast<std::uint32_t>(p[1]) << 8U | p[2];
}

/// An image with a number of colours. Its width is not a multiple of the pixels per byte.
RgbImage image_of(int colours) {
  RgbImage image(21, 17);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto colour = static_cast<std::uint8_t>(static_cast<int>(i) * 5 % colours);
    image.pixels[i] = {colour, static_cast<std::uint8_t>(255 - colour), 7};
  }
  return image;
}

TEST(IndexedPng, KeepsEveryPixelOfUpTo256Colours) {
  for (const int colours : {1, 2, 3, 4, 5, 16, 17, 256}) {
    const RgbImage image = image_of(colours);
    const auto pixels = read_back(indexed_png(image), image.width, image.height);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      ASSERT_EQ(pixels[i] & 0xffffffU, rgb_of(image.pixels[i])) << colours << " colours, " << i;
    }
  }
}

TEST(IndexedPng, QuantisesMoreThan256Colours) {
  RgbImage image(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      image.at(x, y) = {static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(4 * y), 128};
    }
  }
  const auto pixels = read_back(indexed_png(image), 64, 64);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int red = static_cast<int>(pixels[i] >> 16U & 0xffU);
    ASSERT_LE(std::abs(red - image.pixels[i][0]), 8);  // half of the step of 4 bits
  }
}

TEST(IndexedPng, MakesOneColourTransparent) {
  RgbImage image(3, 1);
  image.at(1, 0) = {255, 0, 255};
  const auto pixels = read_back(indexed_png(image, Pixel{255, 0, 255}), 3, 1);
  EXPECT_EQ(pixels[0] >> 24U, 255U);
  EXPECT_EQ(pixels[1] >> 24U, 0U);
}

}  // namespace
}  // namespace adit
