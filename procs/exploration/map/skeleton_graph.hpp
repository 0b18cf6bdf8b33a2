// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

/// The middle lines of the reachable cells, one cell wide and with their connectivity: parallel
/// thinning (Guo and Hall 1989, algorithm A1). 1 for the cells of the skeleton. What is the same
/// place in several layers appears once, so that the lines end where layers meet.
Grid2<std::uint8_t> skeleton(const DrivableSpace& space);

/// A branch of the skeleton between two nodes.
struct Line {
  int from = 0;
  int to = 0;
  std::vector<Eigen::Vector2d> points;  ///< p_map, from node to node
  double clearance_m = 0.0;             ///< least clearance along it [m]
  bool removed = false;
};

/// A junction or an end of the skeleton.
struct LineNode {
  Eigen::Vector2d p_map{0.0, 0.0};
  double clearance_m = 0.0;
};

/// The skeleton as a graph, with every junction and every end.
struct LineGraph {
  std::vector<LineNode> nodes;
  std::vector<Line> lines;
};

LineGraph line_graph(const DrivableSpace& space, const Grid2<std::uint8_t>& skeleton);

/// Simplifies a polyline; no removed point lies farther from the result than the tolerance (Douglas
/// and Peucker 1973).
std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& points,
                                        double tolerance_m);

double length_of(const std::vector<Eigen::Vector2d>& points);

}  // namespace adit
