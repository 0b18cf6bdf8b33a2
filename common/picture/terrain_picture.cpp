// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/terrain_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/picture/canvas.hpp"
#include "common/picture/map_panel.hpp"
#include "common/picture/palette.hpp"

namespace adit {
namespace {

constexpr double kBlackM = 0.3;  // coefficient: impassable for wheels and belly
constexpr double kWhiteM = 3.0;  // clearance
constexpr Colour kBlack = rgb(0x000000);
constexpr Colour kNoRoof = rgb(0xd3e6c8);
constexpr Colour kBetweenBeams = rgb(0xc4c4c4);

struct GroundColour {
  Ground ground;
  Colour colour;
  const char* name;
};
constexpr std::array<GroundColour, 4> kUnknown = {
    {{Ground::kNeverObserved, rgb(0xe2d6b5), "never observed"},
     {Ground::kOccluded, rgb(0xb3a6cf), "occluded"},
     {Ground::kBelowRay, rgb(0xe8b184), "below a beam"},
     {Ground::kNoReturn, rgb(0x86b5dc), "no return: water?"}}};

Colour of_coefficient(const TerrainCell& cell) {
  if (!std::isfinite(cell.coefficient_m)) return kBlack;
  return blend(kOpen, kBlack, std::clamp(cell.coefficient_m / kBlackM, 0.0, 1.0));
}

Colour of_clearance(const TerrainCell& cell) {
  if (!std::isfinite(cell.clearance_m)) return kNoRoof;
  return blend(kBlack, kOpen, std::clamp(cell.clearance_m / kWhiteM, 0.0, 1.0));
}

Colour colour_of(const TerrainCell& cell, TerrainLayer layer) {
  for (const GroundColour& unknown : kUnknown) {
    if (cell.ground == unknown.ground) return unknown.colour;
  }
  if (layer == TerrainLayer::kCoefficient) return of_coefficient(cell);
  if (layer == TerrainLayer::kClearance) return of_clearance(cell);
  return cell.count > 0 ? kOpen : kBetweenBeams;
}

}  // namespace

RgbImage terrain_image(const TerrainMap& map, TerrainLayer layer) {
  RgbImage image(map.cells.columns(), map.cells.rows());
  for (int row = 0; row < map.cells.rows(); ++row) {
    for (int column = 0; column < map.cells.columns(); ++column) {
      image.at(column, map.cells.rows() - 1 - row) =
          rgb_pixel(colour_of(map.cells.at({column, row}), layer));
    }
  }
  return image;
}

const char* title_of(TerrainLayer layer) {
  switch (layer) {
    case TerrainLayer::kCoefficient:
      return "Terrain: bright is easy to pass";
    case TerrainLayer::kClearance:
      return "Height of the roof above the ground";
    case TerrainLayer::kKnowledge:
      return "State of the ground";
  }
  return "";
}

Legend legend_of(TerrainLayer layer) {
  Legend legend;
  switch (layer) {
    case TerrainLayer::kCoefficient:
      legend = {{kOpen, "0 to 0.3 m of unevenness", kBlack}};
      break;
    case TerrainLayer::kClearance:
      legend = {{kBlack, "0 to 3 m", kOpen}, {kNoRoof, "no roof observed", {}}};
      break;
    case TerrainLayer::kKnowledge:
      legend = {{kOpen, "observed", {}}, {kBetweenBeams, "between beams", {}}};
      break;
  }
  for (const GroundColour& unknown : kUnknown) legend.push_back({unknown.colour, unknown.name, {}});
  return legend;
}

namespace {

constexpr double kWidth = 800.0;

}  // namespace

void write_terrain_png(const TerrainMap& map, const std::filesystem::path& path,
                       TerrainLayer layer) {
  write_sheet(path, kWidth, [&](const Canvas& canvas, double left, double top) {
    const MapPanel panel(canvas, map, left, top, kWidth);
    panel.draw(terrain_image(map, layer), title_of(layer));
    const Eigen::Vector2d body = panel.pixel({0.0, 0.0});
    canvas.colour(kOpen);
    canvas.disc(body.x(), body.y(), 9.0);
    canvas.colour(kStart);
    canvas.disc(body.x(), body.y(), 7.0);
    Legend legend = legend_of(layer);
    legend.push_back({kStart, "the robot", {}});
    return panel.finish(legend);
  });
}

}  // namespace adit
