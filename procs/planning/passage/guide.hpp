// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/passage/elastic_band.hpp"
#include "procs/planning/passage/wall_distance.hpp"

namespace adit {

/// The chain of cells that an elastic band starts from: Dijkstra's search over the cells that the
/// middle of the body may cross, whatever its heading. Cells at the walls cost more than those in
/// the middle.
class Guide {
 public:
  Guide(const TerrainMap& terrain, const WallDistance& walls, const GoalField& goals,
        const Vehicle& vehicle);

  /// From the robot to the cell with the most progress for its cost, in level. Empty outside the
  /// map.
  [[nodiscard]] Polyline to_most_progress(const Eigen::Vector2d& p_level_body);

 private:
  using Entry = std::pair<double, std::size_t>;  ///< cost [cells] and cell

  [[nodiscard]] double gain(std::size_t cell) const;
  [[nodiscard]] std::size_t search(std::size_t start);
  void expand(std::size_t cell);
  void reach(const Eigen::Vector2i& at, std::size_t from, double step);

  const TerrainMap& terrain_;
  const WallDistance& walls_;
  const GoalField& goals_;
  double free_m_;  ///< least distance of the middle of the body from walls
  std::vector<double> costs_;
  std::vector<std::size_t> from_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace adit
