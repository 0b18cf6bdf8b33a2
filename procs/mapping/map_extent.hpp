// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "procs/mapping/local_walls.hpp"

namespace adit {

/// Where the walls of a local map are, roughly: enough to say how much of one map another may see
/// again, for hundreds of maps at a time. In the frame of the local map.
class MapExtent {
 public:
  MapExtent() = default;
  explicit MapExtent(const LocalWalls& walls);

  /// Share of the other's walls that lie where this one has walls, to a metre or two.
  [[nodiscard]] double overlap(const MapExtent& other, const Pose2& T_this_other) const;

  /// Share of its walls that lie where others have walls, each of them at its `T_this_other`.
  struct Placed {
    const MapExtent* extent = nullptr;
    Pose2 T_this_other;
  };
  [[nodiscard]] double seen_by(const std::vector<Placed>& others) const;

  /// The circle around all walls; radius 0 where there are none.
  [[nodiscard]] const Eigen::Vector2d& centre() const { return centre_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }

 private:
  [[nodiscard]] bool covers(const Eigen::Vector2d& p) const;

  std::vector<Eigen::Vector2d> samples_;  ///< middle of each square with a wall
  std::vector<std::int64_t> covered_;     ///< these squares and those around them, in order
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  double radius_m_ = 0.0;
};

}  // namespace adit
