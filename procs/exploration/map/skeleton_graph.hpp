// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

/// The middle lines of what can be reached, one cell wide and connected as it is: parallel thinning
/// (Guo and Hall 1989). 1 where a cell is on one.
Grid2<std::uint8_t> skeleton(const DrivableSpace& space);

/// A stretch of skeleton between two nodes.
struct Line {
  int from = 0;
  int to = 0;
  std::vector<Eigen::Vector2d> points;  ///< p_map, from node to node
  double clearance_m = 0.0;             ///< the least along it
  bool removed = false;
};

/// A place where the skeleton branches or ends.
struct LineNode {
  Eigen::Vector2d p_map{0.0, 0.0};
  double clearance_m = 0.0;
};

/// The skeleton as it is: every branching and every end.
struct LineGraph {
  std::vector<LineNode> nodes;
  std::vector<Line> lines;
};

LineGraph line_graph(const DrivableSpace& space, const Grid2<std::uint8_t>& skeleton);

/// Fewer points, none of those left out farther than this from the line (Douglas and Peucker 1973).
std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& points,
                                        double tolerance_m);

double length_of(const std::vector<Eigen::Vector2d>& points);

}  // namespace adit
