// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

/// What a way may lead over.
enum class PathPreference {
  kAnyDrivable,  ///< what looks drivable, nearly as gladly as what was driven
  kDriven,  ///< only where it spares much what was not driven yet: nobody knows what lies there
};

/// The ways from one place to all that can be reached: Dijkstra's search over cells, eight
/// neighbours, which prefers where the body has been already, and not to graze walls.
class ShortestPathTree {
 public:
  /// Only as far as needed to reach these places, where any are given.
  ShortestPathTree(const DrivableSpace& space, const Eigen::Vector2d& p_map_from,
                   PathPreference preference, const std::vector<Eigen::Vector2d>& targets = {});

  /// Length of the way [m]; nothing where there is none.
  [[nodiscard]] std::optional<double> distance_m(const Eigen::Vector2d& p_map) const;
  /// Places from there to here, both ends included, a cell apart; empty where there is no way.
  [[nodiscard]] std::vector<Eigen::Vector2d> path_from(const Eigen::Vector2d& p_map) const;

 private:
  static constexpr std::uint8_t kNoStep = 255;

  [[nodiscard]] std::optional<std::size_t> reached(const Eigen::Vector2d& p_map) const;
  void search(const DrivableSpace& space, std::size_t from, PathPreference preference,
              const std::vector<Eigen::Vector2d>& targets);

  double resolution_m_;
  Grid2<float> length_m_;
  Grid2<std::uint8_t> back_;  ///< which neighbour it was reached from
};

}  // namespace adit
