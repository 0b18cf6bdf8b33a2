// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// A line through points, by the distance along it.
class Polyline {
 public:
  /// At least one point.
  explicit Polyline(std::vector<Eigen::Vector2d> points);

  [[nodiscard]] const std::vector<Eigen::Vector2d>& points() const { return points_; }
  [[nodiscard]] double length_m() const { return at_m_.back(); }
  /// The point at a distance along the line [m]; beyond its ends, the end.
  [[nodiscard]] Eigen::Vector2d at(double distance_m) const;
  /// The place on a line of a point beside it.
  struct Nearest {
    double at_m = 0.0;      ///< distance along the line
    double beside_m = 0.0;  ///< of the point from it; infinite if the part has no length
  };
  /// The nearest place between two distances along the line, which may cross itself [m].
  [[nodiscard]] Nearest nearest(const Eigen::Vector2d& p, double from_m, double to_m) const;
  /// The chord over `reach_m` to either side, as far as the line goes: its direction there. Zero
  /// for a line without length.
  [[nodiscard]] Eigen::Vector2d chord_at(double distance_m, double reach_m) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> at_m_;  // distance of each
};

}  // namespace adit
