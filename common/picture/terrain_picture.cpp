// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/terrain_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/picture/canvas.hpp"
#include "common/picture/palette.hpp"
#include "common/picture/scale_bar.hpp"

namespace adit {
namespace {

constexpr double kBlackM = 0.5;  // coefficient
constexpr int kSideMin = 800;    // of the drawn map [pixels]
constexpr int kSideMax = 2400;
constexpr int kFoot = 90;
constexpr double kUnit = 1.0;

struct Key {
  Ground ground;
  Colour colour;
  const char* name;
};
constexpr std::array<Key, 4> kUnknown = {{{Ground::kNeverSeen, kPaper, "never seen"},
                                          {Ground::kShadow, rgb(0x8f7fb5), "in shadow"},
                                          {Ground::kBelowRay, rgb(0xf07800), "below a beam"},
                                          {Ground::kNoReturn, rgb(0x2f6fc1), "no return"}}};

Colour colour_of(const TerrainCell& cell) {
  for (const Key& key : kUnknown) {
    if (cell.ground == key.ground) return key.colour;
  }
  return blend(kOpen, rgb(0x000000), std::clamp(cell.coefficient_m / kBlackM, 0.0, 1.0));
}

RgbImage::Pixel pixel(const Colour& colour) {
  const auto byte = [](double share) {
    return static_cast<std::uint8_t>(std::lround(255 * share));
  };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

int pixels_per_cell(const TerrainMap& map) {
  const int side = std::max(map.columns, map.rows);
  const int enough = (kSideMin + side - 1) / side;
  return std::clamp(enough, 1, std::max(kSideMax / side, 1));
}

RgbImage enlarged(const RgbImage& image, int times) {
  RgbImage large(image.width * times, image.height * times);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) large.at(x, y) = image.at(x / times, y / times);
  }
  return large;
}

void draw_body(const Canvas& canvas, const TerrainMap& map, double pixels_per_metre) {
  const Eigen::Vector2d p = -map.p_level_corner * pixels_per_metre;
  const double y = map.rows * map.cell_m * pixels_per_metre - p.y();
  canvas.colour(kOpen);
  canvas.disc(p.x(), y, 9.0);
  canvas.colour(kStart);
  canvas.disc(p.x(), y, 7.0);
}

void draw_keys(const Canvas& canvas, int top, double right) {
  double x = right;
  for (auto key = kUnknown.rbegin(); key != kUnknown.rend(); ++key) {
    x -= 120.0;
    canvas.colour(kInk);
    canvas.fill_rectangle(x + 9.0, top + 19.0, 92.0, 18.0);
    canvas.colour(key->colour);
    canvas.fill_rectangle(x + 10.0, top + 20.0, 90.0, 16.0);
    canvas.colour(kInk);
    canvas.text(key->name, x + 55.0, top + 60.0, 15.0, false, Align::kCentre);
  }
}

}  // namespace

RgbImage terrain_image(const TerrainMap& map) {
  RgbImage image(map.columns, map.rows);
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      image.at(column, map.rows - 1 - row) = pixel(colour_of(map.at(column, row)));
    }
  }
  return image;
}

void write_terrain_png(const TerrainMap& map, const std::filesystem::path& path) {
  const int times = pixels_per_cell(map);
  const RgbImage image = enlarged(terrain_image(map), times);
  const double pixels_per_metre = times / map.cell_m;
  const int width = std::max(image.width, kSideMin);
  const Canvas canvas(width, image.height + kFoot);
  canvas.colour(kPaper);
  canvas.fill_rectangle(0.0, 0.0, width, image.height + kFoot);
  canvas.image(image, 0, 0);
  draw_body(canvas, map, pixels_per_metre);
  draw_scale_bar(canvas, 20.0, image.height + 28.0, scale_bar_m(width / pixels_per_metre / 5.0),
                 pixels_per_metre, kUnit);
  draw_keys(canvas, image.height, width);
  canvas.write_png(path);
}

}  // namespace adit
