// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/path/planned_path.hpp"
#include "common/terrain/terrain_map.hpp"

namespace adit {

/// Cells in grey, row by row, 0 black to 255 white.
struct GreyCells {
  std::string label;
  int columns = 0;
  std::vector<std::uint8_t> grey;

  [[nodiscard]] int rows() const {
    return columns == 0 ? 0 : static_cast<int>(grey.size()) / columns;
  }
};

/// How a plan came about.
struct PlanPicture {
  std::string title;  ///< one line, UTF-8
  TerrainMap terrain;
  PlannedPath path;
  double length_m = 0.0;           ///< of the vehicle
  double width_m = 0.0;            ///< likewise
  std::vector<GreyCells> slices;   ///< of the C-space, with the cells of the terrain
  std::vector<GreyCells> kernels;  ///< small, their cells drawn larger
};

/// Draws a plan as PNG, y up: the terrain map in grey, bright where it is easy (the paper's figures
/// 5b and 7), with the path or what blocks it; C-space maps beside it, and kernels (figure 5c)
/// below. Throws std::runtime_error where the file cannot be written.
void write_plan_png(const PlanPicture& picture, const std::filesystem::path& path);

}  // namespace adit
