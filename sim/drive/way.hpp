// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// A line of straight legs in the plan, frame `world`. Places on it count in metres from its start;
/// behind the end it goes on straight.
class LeggedWay {
 public:
  /// At least two points, no two neighbours the same.
  explicit LeggedWay(std::vector<Eigen::Vector2d> points);

  [[nodiscard]] double length_m() const { return starts_m_.back(); }
  [[nodiscard]] Eigen::Vector2d at(double s_m) const;
  /// The leg at a place, from 0; at a corner the one that follows.
  [[nodiscard]] std::size_t leg(double s_m) const;
  [[nodiscard]] double heading_rad(std::size_t leg) const;
  /// Of the place nearest to a point, among those between two places of the way.
  [[nodiscard]] double nearest_m(const Eigen::Vector2d& p_world, double from_m, double to_m) const;

 private:
  [[nodiscard]] Eigen::Vector2d direction(std::size_t leg) const;

  std::vector<Eigen::Vector2d> points_;
  std::vector<double> starts_m_;  ///< of each leg, and the end
};

}  // namespace adit
