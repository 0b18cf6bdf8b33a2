// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/convex_polygon.hpp"
#include "common/grid/grid2.hpp"
#include "common/picture/rgb_image.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// Grey cells with a label.
struct GreyCells {
  std::string label;
  Grid2<std::uint8_t> grey;  ///< 0 black to 255 white
};

/// One pixel for each cell, the last row at the top.
RgbImage grey_image(const GreyCells& cells);

/// The steps of a plan: terrain, C-space, kernels and path.
struct PlanPicture {
  /// Grey values of the slices; passable cells lie between the last two, darker with cost.
  static constexpr std::uint8_t kLethalGrey = 0;
  static constexpr std::uint8_t kUnknownGrey = 90;
  static constexpr std::uint8_t kCostlyGrey = 120;
  static constexpr std::uint8_t kFlatGrey = 255;
  /// Grey values of the kernels: under the wheels, between them, and the margin, which has no
  /// weight but must hold no obstacle.
  static constexpr std::uint8_t kWheelGrey = 0;
  static constexpr std::uint8_t kBetweenGrey = 170;
  static constexpr std::uint8_t kMarginGrey = 225;

  std::string title;  ///< one line, UTF-8
  TerrainMap terrain;
  PlannedPath path;
  ConvexPolygon outline{{}};          ///< of the vehicle, in the body frame
  std::vector<GreyCells> slices;      ///< of the C-space, with the cells of the terrain
  std::vector<GreyCells> kernels;     ///< small, drawn enlarged
  std::vector<std::uint8_t> reached;  ///< 1: cells that the robot can reach; or empty
  std::optional<PlanGoal> goal;
  std::optional<RgbImage> scan;    ///< a view of the 3D scan
  std::vector<std::string> facts;  ///< lines of text below it
};

// Each function draws a PNG, maps with y up, and throws std::runtime_error if it cannot be written.

/// The terrain in grey, bright where it is easy, with the path or the obstacles that block it (the
/// paper's figure 7).
void write_path_png(const PlanPicture& picture, const std::filesystem::path& path);
/// Slices of the C-space by heading.
void write_slices_png(const PlanPicture& picture, const std::filesystem::path& path);
/// The oriented kernels (the paper's figure 5c).
void write_kernels_png(const PlanPicture& picture, const std::filesystem::path& path);
/// All of these and the 3D scan on one sheet (the paper's figure 5).
void write_plan_png(const PlanPicture& picture, const std::filesystem::path& path);

}  // namespace adit
