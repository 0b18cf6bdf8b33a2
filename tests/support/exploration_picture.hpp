// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/types/exploration.hpp"
#include "procs/exploration/exploration.hpp"

namespace adit {

/// The content of a picture of an exploration.
struct ExplorationPicture {
  enum class Cell : std::uint8_t { kUnseen, kWall, kFree, kDrivable };

  std::string title;  ///< one line, UTF-8
  double cell_m = 0.2;
  Eigen::Vector2d p_map_corner{0.0, 0.0};  ///< lowest corner of the cells
  int columns = 0;
  std::vector<Cell> cells;  ///< row by row from the lowest
  ExplorationReport report;
  std::vector<Eigen::Vector2d> traversed_path;  ///< of the robot, p_map; may be empty
};

/// The picture of the current state of an exploration, with the traversed path in map.
ExplorationPicture exploration_picture(const std::string& title, const Exploration& exploration,
                                       std::vector<Eigen::Vector2d> traversed_path = {});

/// Draws the observed space as PNG, y up, four pixels per cell if the sheet is large enough: centre
/// lines of corridors, junctions, dead ends, and the frontiers by their state. Throws
/// std::runtime_error if the file cannot be written.
void write_exploration_png(const ExplorationPicture& picture, const std::filesystem::path& path);

}  // namespace adit
