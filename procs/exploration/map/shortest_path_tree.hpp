// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

/// Cells that paths prefer.
enum class PathPreference {
  kAnyDrivable,  ///< all drivable cells, with a slight preference for driven ones
  kDriven,       ///< driven cells, unless a detour over them is much longer: others may turn out
                 ///< impassable
};

/// Shortest paths from one place to all reachable cells: Dijkstra's algorithm on the 8-connected
/// grid, with costs that prefer driven cells and keep away from walls and from obstacles that only
/// 3D scans show. Cells that are the same
/// place in two layers are connected at no cost.
class ShortestPathTree {
 public:
  /// Stops when all `targets` are reached, if there are any.
  ShortestPathTree(const DrivableSpace& space, const Eigen::Vector2d& p_map_from,
                   PathPreference preference, const std::vector<Eigen::Vector2d>& targets = {});

  /// Length of the path [m]; empty if there is none.
  [[nodiscard]] std::optional<double> distance_m(const Eigen::Vector2d& p_map) const;
  /// Points from `p_map` to the root of the tree, both included, a cell apart; empty if there is no
  /// path.
  [[nodiscard]] std::vector<Eigen::Vector2d> path_from(const Eigen::Vector2d& p_map) const;

 private:
  static constexpr std::uint8_t kNoStep = 255;

  [[nodiscard]] std::optional<std::size_t> reached(const Eigen::Vector2d& p_map) const;
  void search(const DrivableSpace& space, std::size_t from, PathPreference preference,
              const std::vector<Eigen::Vector2d>& targets);

  double resolution_m_;
  Grid2<float> length_m_;
  /// Direction to the predecessor, as an index into around(), or 8 + the layer in which it is the
  /// same place.
  Grid2<std::uint8_t> back_;
  SharedCells shared_;
};

}  // namespace adit
