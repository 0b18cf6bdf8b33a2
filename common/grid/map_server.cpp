// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/grid/map_server.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace adit {
namespace {

// The shades of map_saver. That of the unknown lies between the two thresholds below.
constexpr char kFreeShade = static_cast<char>(254);
constexpr char kUnknownShade = static_cast<char>(205);
constexpr char kOccupiedShade = 0;

char shade(CellState state) {
  switch (state) {
    case CellState::kFree:
      return kFreeShade;
    case CellState::kOccupied:
      return kOccupiedShade;
    case CellState::kUnknown:
      break;
  }
  return kUnknownShade;
}

std::string pgm(const OccupancyGrid& grid, const CellBox& box) {
  std::string text =
      "P5\n" + std::to_string(box.size().x()) + " " + std::to_string(box.size().y()) + "\n255\n";
  for (int j = box.to.y() - 1; j >= box.from.y(); --j) {
    for (int i = box.from.x(); i < box.to.x(); ++i) text += shade(grid.state({i, j}));
  }
  return text;
}

std::string yaml(const OccupancyGrid& grid, const CellBox& box, const std::string& image) {
  const Eigen::Vector2d origin = grid.resolution_m() * box.from.cast<double>();
  char text[512];
  std::snprintf(text, sizeof(text),
                "image: %s\nmode: trinary\nresolution: %.6f\norigin: [%.6f, %.6f, 0.0]\n"
                "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
                image.c_str(), grid.resolution_m(), origin.x(), origin.y());
  return text;
}

void write_file(const std::filesystem::path& path, const std::string& contents) {
  std::ofstream out(path, std::ios::binary);
  out << contents;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

void write_map_server(const OccupancyGrid& grid, const std::filesystem::path& folder,
                      const std::string& stem) {
  CellBox box = grid.known_box();
  box.from -= Eigen::Vector2i(1, 1);
  box.to += Eigen::Vector2i(1, 1);
  write_file(folder / (stem + ".pgm"), pgm(grid, box));
  write_file(folder / (stem + ".yaml"), yaml(grid, box, stem + ".pgm"));
}

}  // namespace adit
