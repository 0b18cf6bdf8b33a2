// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// A line in level along which a robot is to go as far as it can.
class GoalRoute {
 public:
  /// The place of the line that is nearest to another place.
  struct Projection {
    double s_m = 0.0;         ///< along the line; beyond its end it goes on straight
    double lateral_m = 0.0;   ///< from there
    Eigen::Vector2d tangent;  ///< of the line there, a unit vector
  };

  GoalRoute() = default;
  /// Points that lie on each other are left out.
  explicit GoalRoute(const std::vector<Eigen::Vector2d>& points);

  /// Whether there is no line: fewer than two places.
  [[nodiscard]] bool empty() const { return points_.size() < 2; }
  [[nodiscard]] double length_m() const { return starts_m_.empty() ? 0.0 : starts_m_.back(); }
  /// Of a line that is not empty. Where several are as near, the first.
  [[nodiscard]] Projection nearest(const Eigen::Vector2d& p_level) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> starts_m_;  ///< way at each point
};

}  // namespace adit
